// SPDX-License-Identifier: GPL-3.0-or-later
// Where on triangles the contact springs of vertices stand, when layers flow along each other: a foot is the point of
// the other layer that is nearest to its vertex, and slides along as they do. SI units.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet::collide {

// Whether a vertex, v[0], lies beside the mesh's border rather than over the triangle of the other three: what is
// nearest to it there is on the border, and off the triangle's normal by more than 15 degrees. A layer faces what is
// over and under it, by half its thickness; a spring to a rim from what is beside it would hold the rim back as it
// flows.
[[nodiscard]] bool beside_border(const Connectivity& mesh, const std::array<std::uint32_t, 4>& v,
                                 std::span<const Vector3> positions);

// Lets the feet of springs slide that hold nothing along the layers, to the nearest points of the triangles there, from
// triangle to triangle; their triangles are of the mesh. Takes out, and returns as they were, those that came beside a
// border or to a triangle on which their vertex has a spring already; `had` is one value for each spring.
[[nodiscard]] std::vector<ContactSpring> let_feet_slide(std::vector<ContactSpring>& springs, std::vector<double>& had,
                                                        const Connectivity& mesh, std::span<const Vector3> positions);

} // namespace sheet::collide
