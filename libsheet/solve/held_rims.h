// SPDX-License-Identifier: GPL-3.0-or-later
// Rims of liquid that flows on a solid. Where the solid is wetted a rim advances but does not retreat: it leaves a
// film. A rim vertex stays with its solid as long as the solid pushes it outward (array touch_force): what flows is
// dragged that way when it begins to retreat, and what is held is pushed that way until it wants to advance. What a
// hold keeps from moving outward, as the side of a strip that stands for a layer without end, is no such rim.
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Whether rims are held on any of the scene's solids.
[[nodiscard]] bool holds_rims(const Scene& scene);

// Of vertices that touch one solid, those that it keeps from retreating.
[[nodiscard]] std::vector<std::uint32_t> held_rims(const Scene& scene, const formats::Frame& frame,
                                                   const Connectivity& mesh, std::span<const std::uint32_t> touching);

} // namespace sheet
