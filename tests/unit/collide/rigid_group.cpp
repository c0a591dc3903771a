// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/rigid_group.h"

#include <random>

#include <gtest/gtest.h>

namespace sheet::collide {
namespace {

struct Cloud {
  std::vector<std::uint32_t> members;
  std::vector<double> mass;
  std::vector<Vector3> x, y;

  explicit Cloud(std::uint32_t count) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::uint32_t v = 0; v < count; ++v) {
      members.push_back(v);
      mass.push_back(1.5 + uniform(random));
      x.emplace_back(uniform(random), uniform(random), uniform(random));
      y.emplace_back(uniform(random), uniform(random), uniform(random));
    }
  }
  void move(const Eigen::Isometry3d& motion) {
    for (std::size_t v = 0; v < x.size(); ++v)
      y[v] = motion * x[v];
  }
};

TEST(Sets, JoinsAreTransitive) {
  Sets sets(8);
  sets.join(5, 3);
  sets.join(7, 1);
  sets.join(3, 7);
  sets.join(2, 6);
  sets.join(6, 2);
  const std::vector<std::vector<std::uint32_t>> wanted = {{1, 3, 5, 7}, {2, 6}};
  EXPECT_EQ(sets.all(), wanted);
}

TEST(RigidGroup, CommonMotionIsFound) {
  for (const std::uint32_t count : {1U, 2U, 3U, 10U}) {
    Cloud cloud(count);
    cloud.move(Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(2.5, Vector3(1, -2, 0.5).normalized()));
    const auto motion = common_motion(cloud.members, cloud.x, cloud.y);
    ASSERT_TRUE(motion) << count;
    for (const std::uint32_t v : cloud.members)
      EXPECT_LT(((*motion)(cloud.x[v]) - cloud.y[v]).norm(), 1e-12);
    EXPECT_NEAR(motion->turn.determinant(), 1, 1e-12);
  }
  Cloud cloud(10);
  EXPECT_FALSE(common_motion(cloud.members, cloud.x, cloud.y));
  cloud.move(Eigen::Isometry3d::Identity());
  for (Vector3& y : cloud.y)
    y.z() = -y.z(); // a mirror is no motion
  EXPECT_FALSE(common_motion(cloud.members, cloud.x, cloud.y));
}

TEST(RigidGroup, MotionOfARigidBodyIsItsOwn) {
  Cloud cloud(10);
  const Vector3 rate(0.02, -0.01, 0.03);
  for (std::size_t v = 0; v < cloud.x.size(); ++v)
    cloud.y[v] = cloud.x[v] + Vector3(1, 2, 3) + rate.cross(cloud.x[v]);
  const auto motion = momentum_motion(cloud.members, cloud.mass, cloud.x, cloud.y);
  ASSERT_TRUE(motion);
  for (const std::uint32_t v : cloud.members)
    EXPECT_LT(((*motion)(cloud.x[v]) - cloud.y[v]).norm(), 0.5 * rate.squaredNorm() * 2);
  EXPECT_FALSE(momentum_motion(cloud.members, cloud.mass, cloud.x, [&] {
    for (std::size_t v = 0; v < cloud.x.size(); ++v)
      cloud.y[v] = cloud.x[v] + 100 * rate.cross(cloud.x[v]);
    return cloud.y;
  }()));
}

TEST(RigidGroup, MomentumIsGivenBack) {
  Cloud cloud(10);
  const Momentum wanted{{1, -2, 3}, {0.5, 4, -1}};
  const Vector3 center(3, 1, -2);
  std::vector<Vector3> velocity(10, Vector3::Zero());
  add_momentum(cloud.members, cloud.mass, cloud.x, velocity, wanted, center);
  const Momentum got = momentum(cloud.members, cloud.mass, cloud.x, velocity, center);
  EXPECT_LT((got.linear - wanted.linear).norm(), 1e-13);
  EXPECT_LT((got.angular - wanted.angular).norm(), 1e-13);
}

} // namespace
} // namespace sheet::collide
