// SPDX-License-Identifier: GPL-3.0-or-later
// How much of one triangle lies over another.
#pragma once
#include <array>

#include "libsheet/geometry/types.h"

namespace sheet::remesh {

using FlatTriangle = std::array<Eigen::Vector2d, 3>;

// Area [m²] of the intersection of two triangles in a plane, whatever their orientation [Sutherland, Hodgman 1974].
[[nodiscard]] double overlap_area(const FlatTriangle& a, const FlatTriangle& b);

// Axes of the plane with this unit normal.
struct PlaneFrame {
  Vector3 first, second;
  explicit PlaneFrame(const Vector3& normal);
  [[nodiscard]] Eigen::Vector2d flat(const Vector3& x) const { return {first.dot(x), second.dot(x)}; }
};

} // namespace sheet::remesh
