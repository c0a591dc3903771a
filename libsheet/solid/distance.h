// SPDX-License-Identifier: GPL-3.0-or-later
// What the contact of a sheet with a solid asks of the solid's shape. Everything is in the solid's own frame, where the
// solid rests; lengths in metres.
#pragma once
#include <array>
#include <limits>
#include <optional>

#include "libsheet/geometry/types.h"

namespace sheet::solid {

using Box3 = Eigen::AlignedBox3d;
using Triangle3 = std::array<Vector3, 3>;

// The signed distance at a point, negative inside, and the unit vector along which it grows: the outward normal.
struct Near {
  double distance;
  Vector3 normal;
};

// A triangle whose corners move along straight lines while s goes from 0 to 1.
struct MovingTriangle {
  Triangle3 start, end;

  [[nodiscard]] Triangle3 at(double s) const {
    return {start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1]), start[2] + s * (end[2] - start[2])};
  }
};

// A point of a triangle, by its barycentric weights, and what is near it. The normal points from the solid to it.
struct TrianglePoint {
  std::array<double, 3> weights;
  Near near;
};

// A point of a moving triangle, at the time s.
struct TriangleHit {
  double s;
  TrianglePoint point;
};

class SolidDistance {
public:
  SolidDistance() = default;
  SolidDistance(const SolidDistance&) = delete;
  SolidDistance& operator=(const SolidDistance&) = delete;
  virtual ~SolidDistance() = default;

  // Everything that is solid lies in this box; infinite for a half-space.
  [[nodiscard]] virtual Box3 bounds() const = 0;

  // Exact up to round-off, everywhere.
  [[nodiscard]] virtual Near nearest(const Vector3& x) const = 0;

  // The signed distance, but where its magnitude is at least `enough`, only something of the same sign whose magnitude
  // lies between `enough` and the true one. Cheaper than `nearest`.
  [[nodiscard]] virtual double distance(const Vector3& x, double /*enough*/) const { return nearest(x).distance; }

  // The earliest s at which the moving triangle comes within `clearance` of the solid's surface, or nothing. Between
  // clearance and clearance + tolerance the answer may be either. The triangle must start outside and not across the
  // surface. Until the returned s every point of the triangle is at least `clearance` away.
  [[nodiscard]] virtual std::optional<TriangleHit> first_hit(const MovingTriangle& triangle, double clearance,
                                                             double tolerance) const = 0;

  // The triangle's distance from the solid, zero where they intersect; at least `enough` where it is more than that.
  // Off by at most `tolerance`, towards zero.
  [[nodiscard]] virtual double separation(const Triangle3& triangle, double enough, double tolerance) const = 0;

  // The point of a triangle where the signed distance is least, within `tolerance` where that takes at most some
  // thousand evaluations: for the response and for measurements, not for guarantees.
  [[nodiscard]] virtual TrianglePoint deepest(const Triangle3& triangle, double tolerance) const;
};

// The point with these barycentric weights.
[[nodiscard]] inline Vector3 point_of(const Triangle3& triangle, const std::array<double, 3>& weights) {
  return weights[0] * triangle[0] + weights[1] * triangle[1] + weights[2] * triangle[2];
}

} // namespace sheet::solid
