// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/facing_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sheet {
namespace {

struct Point {
  double distance;
  Vector3 normal;
};

// Behind the plane through the origin with this unit normal.
auto half_space(const Vector3& normal) {
  return [normal](const Vector3& x) { return Point{normal.dot(x), normal}; };
}

const auto board = half_space(Vector3::UnitY());

// Everything with x > 0 and y > gap.
auto blade(double gap) {
  return [gap](const Vector3& x) {
    const double ahead = -x.x(), under = gap - x.y();
    if (ahead > 0 && under > 0)
      return Point{std::hypot(ahead, under), Vector3(-ahead, -under, 0).normalized()};
    return ahead > under ? Point{ahead, -Vector3::UnitX()} : Point{under, -Vector3::UnitY()};
  };
}

constexpr double gap = 1e-3, edge = 4e-3, least = 2e-4;

GapBeside beside_blade(double x, double y = 1.5e-3) {
  return gap_beside(Vector3(x, y, 0), board, blade(gap), edge, least);
}

TEST(GapBeside, WidensFromTheGapUnderTheEdge) {
  EXPECT_NEAR(beside_blade(1e-2).gap, gap, 1e-15);
  EXPECT_NEAR(beside_blade(-1e-12).gap, gap, 1e-11);
  EXPECT_NEAR(beside_blade(-edge).gap, gap * 3 / 0.75, 1e-12);
  EXPECT_EQ(beside_blade(-2 * edge).gap, std::numeric_limits<double>::infinity());
  EXPECT_EQ(beside_blade(-edge, 5e-4).gap, beside_blade(-edge, 8e-3).gap); // whatever its height
}

TEST(GapBeside, HasTheSlopeOfThat) {
  for (const double x : {-1e-4, -2e-3, -7e-3}) {
    const double step = 1e-7, slope = (beside_blade(x + step).gap - beside_blade(x - step).gap) / (2 * step);
    EXPECT_NEAR(beside_blade(x).slope.x(), slope, 1e-6 * std::abs(slope));
  }
  EXPECT_EQ(beside_blade(1e-2).slope, Vector3(0, 0, 0));
}

// A rod of 1.5 mm radius lies 0.5 mm over the board: what is on top of it or beside it is not between the two.
TEST(GapBeside, IsNotOnTheFarSideOfAWall) {
  const Vector3 axis(0, 2e-3, 0);
  const auto rod = [&](const Vector3& x) {
    const Vector3 way(x.x() - axis.x(), x.y() - axis.y(), 0);
    return Point{way.norm() - 1.5e-3, way.normalized()};
  };
  for (const Vector3& x : {Vector3(0, 5e-3, 0), Vector3(1e-3, 5e-3, 0), Vector3(3e-3, 2e-3, 0)})
    EXPECT_EQ(gap_beside(x, rod, board, 3e-3, 1.5e-4).gap, std::numeric_limits<double>::infinity());
  EXPECT_LT(gap_beside(Vector3(3e-3, 1e-3, 0), board, rod, 3e-3, 1.5e-4).gap, 4e-3); // what lies beside it on the board
}

// The other wall comes down to the own one there: no liquid goes below it.
TEST(GapBeside, IsNotInCorners) {
  for (const double degrees : {61.0, 80.0, 90.0, 120.0, 170.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto wall = half_space(Vector3(-std::sin(angle), std::cos(angle) * -1, 0));
    EXPECT_EQ(gap_beside(Vector3(-2e-3, 5e-4, 0), board, wall, edge, 1e-6).gap, std::numeric_limits<double>::infinity())
        << degrees;
  }
  EXPECT_EQ(gap_beside(Vector3(-2e-3, 5e-4, 0), board, blade(least / 2), edge, least).gap,
            std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace sheet
