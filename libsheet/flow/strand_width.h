// SPDX-License-Identifier: GPL-3.0-or-later
// How wide a strand is, measured from rim to rim, whatever its triangles are. SI units.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet::flow {

// Of the strand that each triangle belongs to [m]; infinite where that is more than two rows of triangles wide, and of
// ears, with two sides on the rim, which are corners. In one row it is the height over the side that lies on a rim,
// where there is none the least height; in two rows what lies to either side of the vertex in the middle, of several of
// these the most.
[[nodiscard]] std::vector<double> strand_widths(const Connectivity& mesh, std::span<const Vector3> x);

// From x straight to the line through a and b [m].
[[nodiscard]] Vector3 way_to_line(const Vector3& x, const Vector3& a, const Vector3& b);

// Of a strand, across a point from which these ways lead to the rims beside it [m]: the shortest way, and the shortest
// one to the other side; infinite if none leads there.
[[nodiscard]] double width_across(std::span<const Vector3> ways);

} // namespace sheet::flow
