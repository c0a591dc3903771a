// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/impossible_speed.h"

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double g = 10, fall_time = 0.1;

Model falling_liquid() {
  Model m;
  m.liquid.viscosity = 3;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -g};
  return m;
}

struct Fall {
  State start = test::at_rest(test::rectangle(1, 1, 5, 5, 0.2), 0.01), end = start;
  Fall() {
    end.time = fall_time;
    for (std::size_t v = 0; v < end.positions.size(); ++v) {
      end.positions[v].z() -= g * fall_time * fall_time / 2;
      end.velocities[v] = {0, 0, -g * fall_time};
    }
  }
};

TEST(ImpossibleSpeed, FallingIsPossible) {
  const Fall fall;
  EXPECT_FALSE(impossible_speed(falling_liquid(), fall.start, fall.end));
}

// One vertex of 36 may have all of the energy that the others have lost, and no more.
TEST(ImpossibleSpeed, OneVertexFlies) {
  Fall fall;
  double mass = 0, own = 0;
  for (std::size_t t = 0; t < fall.end.volumes.size(); ++t)
    for (const auto v : fall.end.mesh->triangles[t]) {
      mass += 1000 * fall.end.volumes[t] / 3;
      own += v == 14 ? 1000 * fall.end.volumes[t] / 3 : 0;
    }
  const double most = std::sqrt(mass * g * (g * fall_time * fall_time / 2) / (0.5 * own));
  fall.end.velocities[14] = {0, 0.99 * most, 0};
  EXPECT_FALSE(impossible_speed(falling_liquid(), fall.start, fall.end));
  fall.end.velocities[14] = {0, 1.01 * most, 0};
  const auto impossible = impossible_speed(falling_liquid(), fall.start, fall.end);
  ASSERT_TRUE(impossible);
  EXPECT_EQ(impossible->vertex, 14U);
  EXPECT_GT(impossible->energy, impossible->work);
}

// What a hold moves may be as fast as it says, and so may what it drags along.
TEST(ImpossibleSpeed, HoldsMoveAsTheyLike) {
  Fall fall;
  Model m = falling_liquid();
  m.gravity.setZero();
  Hold hold;
  hold.vertices = {0};
  hold.velocity = [](double, const Vector3&) { return Vector3(50, 0, 0); };
  hold.motion = [](double, double) { return RigidMotion{}; };
  for (Vector3& v : fall.end.velocities)
    v = {50, 0, 0};
  EXPECT_TRUE(impossible_speed(m, fall.start, fall.end));
  m.holds.push_back(hold);
  EXPECT_FALSE(impossible_speed(m, fall.start, fall.end));
  m.inertia = false;
  m.holds.clear();
  EXPECT_FALSE(impossible_speed(m, fall.start, fall.end)); // nothing has energy
}

// A sheet at rest on which nothing works, whose places have got other last digits in the step.
TEST(ImpossibleSpeed, RoundOffFlies) {
  Fall fall;
  Model m = falling_liquid();
  m.gravity.setZero();
  fall.end = fall.start;
  fall.end.time = fall_time;
  const auto flies_by = [&](double way) {
    fall.end.positions[14] = fall.start.positions[14] + Vector3(0, way, 0);
    fall.end.velocities[14] = {0, way / fall_time, 0};
    return impossible_speed(m, fall.start, fall.end).has_value();
  };
  EXPECT_FALSE(flies_by(1e-15));
  EXPECT_TRUE(flies_by(1e-9));
}

} // namespace
} // namespace sheet
