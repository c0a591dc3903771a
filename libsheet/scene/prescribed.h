// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene prescribes of a frame's motion: which [[hold]]s and whether the inflow are in force at a time, and whom
// they hold. What touches a solid is not asked here.
#pragma once
#include <cstdint>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/axes.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Until they are released, or end [s].
[[nodiscard]] inline bool in_force(const Hold& hold, double t) { return !hold.until || t < *hold.until; }
[[nodiscard]] inline bool in_force(const Inflow& inflow, double t) { return !inflow.until || t < *inflow.until; }

// The bits of the array hold that count at time t. Those beyond the scene's tables do.
[[nodiscard]] std::uint64_t holds_in_force(const Scene& scene, double t);

// The axes that a vertex with these bits is held along; a bit beyond the scene's tables holds all.
[[nodiscard]] Axes held_axes(const Scene& scene, std::uint64_t holds);

// For each of the frame's vertices the axes along which a hold or the inlet prescribes its motion at time t.
[[nodiscard]] std::vector<Axes> prescribed_axes(const formats::Frame& frame, const Scene& scene, double t);

} // namespace sheet::scene
