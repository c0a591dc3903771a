// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points of triangles [Ericson 2005, sections 5.1.5 and 5.1.9-10].
#pragma once
#include "libsheet/solid/distance.h"

namespace sheet::solid {

// The point of a triangle nearest to x, and what part of it that is.
struct NearestOnTriangle {
  enum class Part { corner, edge, face };
  Vector3 point;
  std::array<double, 3> weights;
  Part part;
  std::size_t index; // of the corner; of the edge, opposite the corner of that index
};
[[nodiscard]] NearestOnTriangle nearest_on_triangle(const Vector3& x, const Triangle3& triangle);

// The least distance of two triangles with area: 0 where they intersect.
struct TrianglePair {
  double distance;
  Vector3 first, second;         // the points that are so near
  std::array<double, 3> weights; // of the first
};
[[nodiscard]] TrianglePair nearest_points(const Triangle3& a, const Triangle3& b);

} // namespace sheet::solid
