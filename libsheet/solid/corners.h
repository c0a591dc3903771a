// SPDX-License-Identifier: GPL-3.0-or-later
// Corners between two solids in which liquid turns: what runs down the side of one goes on along another one, on which
// that stands.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/solid/solids.h"

namespace sheet::solid {

// A sheet on solids at the time t [s], under gravity [m/s²].
struct SheetOnSolids {
  std::span<const Vector3> x; // of its vertices [m]
  std::span<const Corners> triangles;
  std::span<const double> thickness, longest_edges; // at each vertex [m]
  std::span<const std::int32_t> rides;              // the solid along which each flows, or no_solid
  double t;
  Vector3 gravity;
};

// Of each vertex, whether it shares a triangle with one that touches another solid: there the sheet goes on to that.
[[nodiscard]] std::vector<std::uint8_t> passing(std::span<const Corners> triangles,
                                                std::span<const std::int32_t> rides);

// Of each vertex, the other solid in whose corner with its own one it turns, or no_solid: one that rests beside it, but
// for belts, at an angle, along which liquid flows, not farther off than its own one by more than two edges or
// thicknesses; and that bears more of the weight, or less, if the sheet has come from there: if it shares a triangle
// with what flows along that. Its own one, if that is a mesh and it turns in a corner of that; what comes down a side
// of a mesh lies along that rather than along the floor.
[[nodiscard]] std::vector<std::int32_t> turned_to(const Solids& solids, const SheetOnSolids& sheet);

} // namespace sheet::solid
