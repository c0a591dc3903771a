// SPDX-License-Identifier: GPL-3.0-or-later
// How deep liquid is where it flows in along a wall. A scene says the thickness h of what enters and its velocity v, so
// the flux h v; where the layer in front of the inlet has become deeper than h, as it flows away slower than v, the
// inlet is under it: as much flows in, as deep as the layer and slower, as under a weir that is drowned [Chow 1959,
// section 14-1]. It is as deep at each vertex of the border as what lies before that (array `emit.border_depth` [m]),
// and flows in at one velocity, h v/H, with H such that as much enters (`emit.depth` [m], a row for each [inflow]): the
// mean depth along the border, where that is level. Without the arrays all depths are h.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/inlet_velocity.h"

namespace sheet::scene {

// H of the inflow of this number [m], at least its thickness. Throws Error (bad_input) where the array is another one.
[[nodiscard]] double inlet_depth(const formats::Frame& frame, const Scene& scene, std::size_t number);

// How deep it flows in at the vertices of its border [m], at least its thickness. Likewise.
[[nodiscard]] std::vector<double> inlet_depths(const formats::Frame& frame, const Scene& scene, std::size_t number,
                                               std::span<const std::uint32_t> border);

// The velocity with which it flows in, from now on [m/s].
[[nodiscard]] InletVelocity inlet_velocity(const formats::Frame& frame, const Scene& scene, std::size_t number);

// Sets H of the inflow; where that is its thickness and the frame has no such array, there still is none.
void put_inlet_depth(formats::Frame& frame, const Scene& scene, std::size_t number, double depth);

// Sets `depths` at the vertices of a border, likewise.
void put_inlet_depths(formats::Frame& frame, const Scene& scene, std::size_t number,
                      std::span<const std::uint32_t> border, std::span<const double> depths);

// Nothing is drowned any more.
void erase_inlet_depths(formats::Frame& frame);

} // namespace sheet::scene
