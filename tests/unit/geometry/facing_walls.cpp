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

// A scraper 1 mm thick that leans by 30 degrees: its lower face rises from the board to 0.5 mm at the edge that it goes
// ahead with. Nothing goes below it over edges of the mesh longer than that face; over shorter ones there is a gap.
TEST(GapBeside, IsNotBeforeWhatClosesWithinAnEdge) {
  const Vector3 lower(std::sin(std::numbers::pi / 6), -std::cos(std::numbers::pi / 6), 0),
      front(-lower.y(), lower.x(), 0);
  const auto scraper = [&](const Vector3& x) { // its edge at (0, 0.5 mm), everything behind both faces
    const Vector3 from = x - Vector3(0, 5e-4, 0);
    const double ahead = front.dot(from), under = lower.dot(from);
    if (ahead > 0 && under > 0)
      return Point{from.norm(), from.normalized()};
    return ahead > under ? Point{ahead, front} : Point{under, lower};
  };
  const Vector3 x(1e-4, 1.5e-3, 0);
  EXPECT_EQ(gap_beside(x, board, scraper, 4e-3, 2e-4).gap, std::numeric_limits<double>::infinity());
  EXPECT_LT(gap_beside(x, board, scraper, 2e-4, 2e-4).gap, 5e-3);
}

// Over a blade's way to its edge and beyond it.
TEST(LeastHeight, IsThatOfTheLowestPlace) {
  EXPECT_NEAR(least_height(Vector3(-2e-3, 0, 0), Vector3(4e-3, 0, 0), board, blade(gap)), gap, 1e-15);
  const auto leans = half_space(Vector3(-std::cos(0.5), -std::sin(0.5), 0)); // over the board, down to it at the origin
  EXPECT_GT(least_height(Vector3(-2e-3, 0, 0), Vector3(1e-3, 0, 0), board, leans), 1e-4);
  EXPECT_NEAR(least_height(Vector3(-2e-3, 0, 0), Vector3(2e-3, 0, 0), board, leans), 0, 1e-15);
}

} // namespace
} // namespace sheet
