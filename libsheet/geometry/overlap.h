// SPDX-License-Identifier: GPL-3.0-or-later
// How much of one triangle lies over another.
#pragma once
#include <array>

#include "libsheet/geometry/types.h"

namespace sheet {

using FlatTriangle = std::array<Eigen::Vector2d, 3>;

[[nodiscard]] inline Eigen::Vector2d middle_of(const FlatTriangle& t) { return (t[0] + t[1] + t[2]) / 3; }

struct Overlap {
  double area = 0;                                  // [m²]
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(); // its centroid [m]
};
// Of two triangles in a plane, whatever their orientation [Sutherland, Hodgman 1974].
[[nodiscard]] Overlap overlap_of(const FlatTriangle& a, const FlatTriangle& b);

// Axes of the plane with this unit normal.
struct PlaneFrame {
  Vector3 first, second;
  explicit PlaneFrame(const Vector3& normal);
  [[nodiscard]] Eigen::Vector2d flat(const Vector3& x) const { return {first.dot(x), second.dot(x)}; }
};

} // namespace sheet
