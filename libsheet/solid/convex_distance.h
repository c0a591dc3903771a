// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles against convex solids, from nothing but the exact signed distance and its gradient.
#pragma once
#include "libsheet/solid/distance.h"

namespace sheet::solid {

// The signed distance d of a convex body is a convex function, so it lies nowhere below its tangent planes:
// d(y) >= d(x) + n(x).(y - x). That bounds it over a whole part of a triangle's sweep by one evaluation at its middle
// and six dot products, exact to second order; parts whose bound is not good enough are halved. A part that is as small
// as the tolerance is a hit, so the search ends. [branch and bound with supporting planes; Boyd, Vandenberghe 2004,
// section 3.1.3]
class ConvexDistance : public SolidDistance {
public:
  [[nodiscard]] std::optional<TriangleHit> first_hit(const MovingTriangle& triangle, double clearance,
                                                     double tolerance) const override;
  [[nodiscard]] double separation(const Triangle3& triangle, double enough, double tolerance) const override;
  [[nodiscard]] TrianglePoint deepest(const Triangle3& triangle, double tolerance) const override;
};

} // namespace sheet::solid
