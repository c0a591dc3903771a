// SPDX-License-Identifier: GPL-3.0-or-later
// The closest points of two features of a triangle mesh: a vertex and a triangle, or two edges. Lengths in any unit.
#pragma once
#include <array>
#include <optional>

#include "libsheet/geometry/types.h"

namespace sheet {

// c = Σ weights[i] x[i] is the vector from the second feature's closest point to the first one's; the weights sum to 0.
struct ClosestPoints {
  std::array<double, 4> weights{}; // vertex, triangle: 1, -λ0, -λ1, -λ2; edges: λ, 1-λ, -κ, κ-1; all λ, κ in [0, 1]
  Vector3 offset = Vector3::Zero(); // c
};

// x[0] the vertex, x[1..3] the triangle, which may be degenerate. Relative error of |c| a few roundings, unless the
// triangle's height is below 1e-7 of its sides.
[[nodiscard]] ClosestPoints closest_vertex_triangle(const std::array<Vector3, 4>& x);

// x[0], x[1] one edge, x[2], x[3] the other; either may have no length. Parallel edges: one of their closest pairs.
[[nodiscard]] ClosestPoints closest_edge_edge(const std::array<Vector3, 4>& x);

// False only if over_triangle, or crossing_edges, has none; in a few operations.
[[nodiscard]] inline bool may_be_over_triangle(const Vector3& x0, const Vector3& x1, const Vector3& x2,
                                               const Vector3& x3) {
  const Vector3 e1 = x2 - x1, e2 = x3 - x1, p = x0 - x1;
  const double a = e1.squaredNorm(), b = e1.dot(e2), c = e2.squaredNorm(), d = e1.dot(p), f = e2.dot(p);
  return c * d - b * f > 0 && a * f - b * d > 0;
}
[[nodiscard]] inline bool may_cross(const Vector3& x0, const Vector3& x1, const Vector3& x2, const Vector3& x3) {
  const Vector3 u = x1 - x0, v = x3 - x2, w = x0 - x2;
  const double a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm(), d = u.dot(w), f = v.dot(w);
  const double determinant = a * c - b * b, of_s = b * f - c * d, of_t = a * f - b * d;
  return of_s > 0 && of_s < determinant && of_t > 0 && of_t < determinant;
}

// The same where they are perpendicular to both features: the vertex is above the inside of the triangle, the edges
// cross seen along their common perpendicular. Cheaper.
[[nodiscard]] std::optional<ClosestPoints> over_triangle(const std::array<Vector3, 4>& x);
[[nodiscard]] std::optional<ClosestPoints> crossing_edges(const std::array<Vector3, 4>& x);

} // namespace sheet
