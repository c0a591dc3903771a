// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/motion.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace sheet::scene {
namespace {

using Eigen::Vector3d;

TEST(Motion, ValueIsPiecewiseLinear) {
  const Timed<double> rate{{{1, 2}, {3, 6}}};
  EXPECT_EQ(value_at(rate, 0), 2);
  EXPECT_EQ(value_at(rate, 1), 2);
  EXPECT_EQ(value_at(rate, 2), 4);
  EXPECT_EQ(value_at(rate, 3), 6);
  EXPECT_EQ(value_at(rate, 9), 6);
  EXPECT_EQ(value_at(Timed<double>{}, 9), 0);
}

TEST(Motion, IntegralIsExact) {
  const Timed<double> rate{{{1, 2}, {3, 6}, {4, 0}}};
  EXPECT_EQ(integral(rate, 1, 3), 8);
  EXPECT_EQ(integral(rate, 0, 1), 2);
  EXPECT_EQ(integral(rate, 0, 10), 2 + 8 + 3 + 0);
  EXPECT_EQ(integral(rate, 1.5, 2), 0.5 * 3.5);
  EXPECT_EQ(integral(rate, 10, 0), -13);
  EXPECT_EQ(integral(rate, 2, 2), 0);
  EXPECT_EQ(integral(Timed<double>{}, 0, 1), 0);
  // Additive over any split.
  for (double t = 0; t < 5; t += 0.3)
    EXPECT_NEAR(integral(rate, 0, t) + integral(rate, t, 5), 13, 1e-14);
}

TEST(Motion, Translation) {
  const Motion motion = Translating{{{{0, Vector3d(0, 0, 0)}, {2, Vector3d(0, 0, 0.4)}}}};
  EXPECT_TRUE(motion_between(motion, 0, 2).isApprox(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.4)), 1e-15));
  EXPECT_TRUE(motion_between(motion, 2, 0).isApprox(Eigen::Isometry3d(Eigen::Translation3d(0, 0, -0.4)), 1e-15));
  EXPECT_EQ(velocity_at(motion, 1, Vector3d(5, 5, 5)), Vector3d(0, 0, 0.2));
  EXPECT_EQ(bounds(motion, -1, 1).speed, 0.2);
  EXPECT_EQ(bounds(motion, 0, 1).acceleration, 0.2);
  EXPECT_FALSE(turns(motion));
}

TEST(Motion, RotationIsRightHandedAboutItsCenter) {
  const Motion motion = Rotating{Vector3d(0, 0, 5), Vector3d(1, 0, 0), {{{0, 0.0}, {2, std::numbers::pi / 2}}}};
  const Eigen::Isometry3d turn = motion_between(motion, 0, 2); // a quarter
  EXPECT_LT((turn * Vector3d(2, 0, 7) - Vector3d(1, 1, 7)).norm(), 1e-15);
  EXPECT_LT((turn * Vector3d(1, 0, 3) - Vector3d(1, 0, 3)).norm(), 1e-15);
  EXPECT_LT((velocity_at(motion, 2, Vector3d(3, 0, 0)) - Vector3d(0, std::numbers::pi, 0)).norm(), 1e-15);
  EXPECT_EQ(bounds(motion, -100, 100).turning, std::numbers::pi / 2);
  EXPECT_EQ(bounds(motion, 0, 1).turning_change, std::numbers::pi / 4);
  EXPECT_TRUE(turns(motion));
}

// A wheel of the radius 0.5 m whose axis is 0.5 m above the ground, y = 0.
TEST(Motion, AWheelThatRollsRestsWhereItTouches) {
  const Vector3d start(1, 0.5, 0);
  const Motion wheel = Rotating{-Vector3d::UnitZ(), start, {{{0, 4}}}, {{{0, Vector3d(2, 0, 0)}}}};
  for (const double t : {-1.0, 0.0, 0.3, 7.0}) {
    const Vector3d axis = start + Vector3d(2 * t, 0, 0);
    EXPECT_LT(velocity_at(wheel, t, axis - Vector3d(0, 0.5, 0)).norm(), 1e-14);
    EXPECT_LT((velocity_at(wheel, t, axis + Vector3d(0, 0.5, 0)) - Vector3d(4, 0, 0)).norm(), 1e-14);
    EXPECT_LT((motion_between(wheel, 0.3, t) * Vector3d(1.6, 0.5, 9) - axis - Vector3d(0, 0, 9)).norm(), 1e-14);
  }
  // The point of its rim that touched at 0.5 s is on a cycloid.
  const double angle = 4 * 0.4;
  const Vector3d cycloid(2 + 0.5 * (angle - std::sin(angle)), 0.5 * (1 - std::cos(angle)), 0);
  EXPECT_LT((motion_between(wheel, 0.5, 0.9) * Vector3d(2, 0, 0) - cycloid).norm(), 1e-14);
  EXPECT_TRUE(turns(wheel));
}

TEST(Motion, OfAnAxisThatSpeedsUp) {
  const Timed<Vector3d> velocity{{{0, Vector3d(0, 0, 0)}, {2, Vector3d(0, 0, 4)}}};
  const Motion motion = Rotating{Vector3d(0, 1, 0), Vector3d(1, 0, 0), {{{1, 0.0}, {2, 3.0}}}, velocity};
  EXPECT_EQ(events(motion), (std::vector<double>{0, 1, 2}));
  EXPECT_LT((velocity_at(motion, 2, Vector3d(2, 5, 4)) - Vector3d(0, 0, 4 - 3)).norm(), 1e-14);
  const MotionBounds most = bounds(motion, 1, 2);
  EXPECT_LT((most.center - Vector3d(1, 0, 1)).norm(), 1e-14);
  EXPECT_EQ(most.speed, 4);
  EXPECT_EQ(most.acceleration, 2);
  EXPECT_EQ(most.turning, 3);
  EXPECT_EQ(most.turning_change, 3);
}

TEST(Motion, StepsComposeToTheWhole) {
  const Motion motion = Rotating{Vector3d(1, 2, 3), Vector3d(0.3, -1, 2), {{{0, 1.0}, {1, -4.0}, {7, 2.0}}}};
  Eigen::Isometry3d whole = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 80; ++i)
    whole = motion_between(motion, 0.1 * i, 0.1 * (i + 1)) * whole;
  EXPECT_LT((whole.matrix() - motion_between(motion, 0, 8).matrix()).norm(), 1e-12);
}

TEST(Motion, FixedStays) {
  EXPECT_TRUE(motion_between(Fixed{}, 0, 100).matrix().isIdentity(0));
  EXPECT_EQ(velocity_at(Fixed{}, 1, Vector3d(1, 2, 3)), Vector3d(0, 0, 0));
  EXPECT_EQ(bounds(Fixed{}, 0, 1).speed, 0);
}

} // namespace
} // namespace sheet::scene
