// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/rounded_corner.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sheet {
namespace {

struct WallPlane {
  double distance;
  Vector3 normal;
};

constexpr double turning_radius = 4e-3;

// A floor y < 0 and a side that leans by this angle off upright, away from it, through the origin.
struct Walls {
  explicit Walls(double leaning) : side(std::cos(leaning), std::sin(leaning), 0) {}
  [[nodiscard]] InCorner at(const Vector3& x, double r = turning_radius) const {
    return in_corner(WallPlane{side.dot(x), side}, WallPlane{x.y(), Vector3::UnitY()}, r);
  }
  Vector3 side;
};

// Where the line is that is d off both walls.
Vector3 line(const Walls& walls, double d) { return {(d - d * walls.side.y()) / walls.side.x(), d, 0}; }

TEST(RoundedCorner, IsAnArcBetweenWalls) {
  for (const double leaning : {-0.4, 0.0, 0.6}) {
    const Walls walls(leaning);
    constexpr double off = 1.5e-3;
    const Vector3 centre = line(walls, off + turning_radius);
    const double from = std::atan2(-walls.side.y(), -walls.side.x()), to = -std::numbers::pi / 2;
    const double first = from > 0 ? from - 2 * std::numbers::pi : from;
    for (const double part : {0.1, 0.5, 0.9}) {
      const double angle = first + part * (to - first);
      const Vector3 out(std::cos(angle), std::sin(angle), 0);
      const InCorner corner = walls.at(centre + turning_radius * out);
      EXPECT_TRUE(corner.rounded);
      EXPECT_NEAR(corner.distance, off, 1e-15);
      EXPECT_LT((corner.normal + out).norm(), 1e-12);
    }
  }
}

TEST(RoundedCorner, IsTheNearerWallElsewhere) {
  const Walls walls(0);
  const InCorner high = walls.at({1e-3, 0.1, 0}), far = walls.at({0.1, 2e-3, 0});
  EXPECT_FALSE(high.rounded);
  EXPECT_EQ(high.distance, 1e-3);
  EXPECT_EQ(high.normal, Vector3::UnitX());
  EXPECT_FALSE(far.rounded);
  EXPECT_EQ(far.distance, 2e-3);
  EXPECT_EQ(far.normal, Vector3::UnitY());
}

TEST(RoundedCorner, BeginsWithoutAJump) {
  const Walls walls(0);
  const double end = 1e-3 + turning_radius; // 1 mm off the side, above the floor
  const InCorner before = walls.at({1e-3, end * (1 + 1e-9), 0}), after = walls.at({1e-3, end * (1 - 1e-9), 0});
  EXPECT_NE(before.rounded, after.rounded);
  EXPECT_NEAR(before.distance, after.distance, 1e-11);
  EXPECT_LT((before.normal - after.normal).norm(), 1e-8);
}

TEST(RoundedCorner, LeavesHalfTheDistanceOfThePlace) {
  for (const double leaning : {-0.4, 0.0, 0.6}) {
    const Walls walls(leaning);
    const Vector3 deep = line(walls, 1e-3) + Vector3(0.3e-3, 0, 0);
    const WallPlane side{walls.side.dot(deep), walls.side}, floor{deep.y(), Vector3::UnitY()};
    const double greatest = rounding_at(side, floor, 1.0);
    EXPECT_NEAR(walls.at(deep, greatest).distance, 0.5e-3, 1e-12);
    EXPECT_EQ(rounding_at(side, floor, 1e-4), 1e-4);
  }
  EXPECT_EQ(rounding_at(WallPlane{-1e-3, Vector3::UnitX()}, WallPlane{1e-3, Vector3::UnitY()}, 1.0), 0);
}

} // namespace
} // namespace sheet
