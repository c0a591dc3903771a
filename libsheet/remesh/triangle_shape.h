// SPDX-License-Identifier: GPL-3.0-or-later
// Area, normal and angles of a triangle, without trigonometric functions: angles are compared by their cosines.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "libsheet/geometry/types.h"

namespace sheet::remesh {

struct TriangleShape {
  double area = 0;
  Vector3 normal = Vector3::Zero(); // unit, zero for a triangle without area
  double sharpest = 1;              // cosine of the smallest angle: 0.5 at best; 1 for a triangle without area

  TriangleShape() = default;
  TriangleShape(const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 ab = b - a, bc = c - b, ca = a - c;
    const Vector3 cross = ab.cross(-ca);
    const double twice = cross.norm();
    area = twice / 2;
    if (!(twice > 0))
      return;
    normal = cross / twice;
    const double x = ab.squaredNorm(), y = bc.squaredNorm(), z = ca.squaredNorm();
    // the smallest angle lies opposite to the shortest side
    if (x <= y && x <= z)
      sharpest = -bc.dot(ca) / std::sqrt(y * z);
    else if (y <= z)
      sharpest = -ca.dot(ab) / std::sqrt(z * x);
    else
      sharpest = -ab.dot(bc) / std::sqrt(x * y);
    sharpest = std::min(sharpest, 1.0);
  }
};

// The cosine of an angle that is better than one of this cosine: by that gain of the cosine, or, where the angle is
// small, twice as large (1 - cos θ ≈ θ²/2).
inline double better_cosine(double cosine, double gain) { return std::max(cosine - gain, 1 - 4 * (1 - cosine)); }

inline double cosine_of_degrees(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

} // namespace sheet::remesh
