// SPDX-License-Identifier: GPL-3.0-or-later
// Rims of liquid that flows on a solid. Where the solid is wetted a rim advances but does not retreat: it leaves a
// film. A rim vertex stays with its wall across the rim as long as the solid pushes it outward (array touch_force):
// what flows is dragged that way when it begins to retreat, and what is held is pushed that way until it wants to
// advance. In a first step those stay that lie uphill. Along the rim it flows as the layer beside it does: the sides of
// a stripe on a wall run down with it. Where the rim turns sharply, and in corners, it stays as a whole. What a hold
// keeps from moving outward, as the side of a strip that stands for a layer without end, is no such rim, nor is what
// turns in the corner of two walls, round which it is pushed.
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Whether rims are held on any of the scene's solids.
[[nodiscard]] bool holds_rims(const Scene& scene);

struct HeldRims {
  std::vector<std::uint32_t> wholly; // held as a whole
  std::vector<Vector3> out;          // of each of the vertices, if it is held across the rim: out of the sheet; or zero
};

// Of vertices that touch one solid, those that it keeps from retreating. turned_to: of each vertex of the sheet, the
// solid in whose corner it turns, or no_solid.
[[nodiscard]] HeldRims held_rims(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh,
                                 std::span<const std::uint32_t> touching, std::span<const std::int32_t> turned_to);

} // namespace sheet
