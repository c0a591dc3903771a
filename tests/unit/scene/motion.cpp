// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/motion.h"

#include <numbers>

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
