// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of liquid that flows along walls: forces, rigid motion, corners, length of steps.
#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

Wall floor_of(const State& s, double height = 0) {
  Wall wall;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [height](double, const Vector3& x) { return WallPoint{x.z() - height, Vector3::UnitZ()}; };
  return wall;
}

State resting(double thickness) {
  State s = test::at_rest(test::rectangle(1, 1, 5, 5, 0), thickness);
  for (Vector3& x : s.positions)
    x.z() = thickness / 2;
  return s;
}

Model heavy_layer() {
  Model m;
  m.viscosity = 3;
  m.density = 2;
  m.gravity = {1.5, 0.5, -9};
  m.reactions = true;
  return m;
}

// The wall bears the weight and takes the momentum that drag takes away.
TEST(Walls, ForcesAndMomentumBalance) {
  State s = resting(0.1);
  for (std::size_t v = 0; v < s.velocities.size(); ++v)
    s.velocities[v] = {1 + 0.1 * static_cast<double>(v % 3), -0.5, 0};
  Model m = heavy_layer();
  m.walls.push_back(floor_of(s));
  StepOptions options;
  options.scheme = Scheme::backward_euler;
  options.newton.tolerance = 1e-12;
  Stepper stepper(m, options);
  const auto momentum = [&](const State& at) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t t = 0; t < at.volumes.size(); ++t)
      for (const auto v : at.mesh->triangles[t])
        sum += m.density * at.volumes[t] / 3 * at.velocities[v];
    return sum;
  };
  double mass = 0;
  for (const double v : s.volumes)
    mass += m.density * v;
  const Vector3 before = momentum(s);
  constexpr double dt = 0.01;
  const StepReport report = stepper.step(s, dt);
  ASSERT_EQ(report.substeps, 1);
  Vector3 force = Vector3::Zero();
  for (const Vector3& f : report.reactions)
    force += f;
  const Vector3 defect = momentum(s) - before - dt * (mass * m.gravity + force);
  EXPECT_LT(defect.norm(), 1e-10 * before.norm());
  EXPECT_NEAR(force.z(), mass * 9, 0.05 * mass * 9); // thickness changes, so it rises a little
  for (const Vector3& v : s.velocities)
    EXPECT_EQ(v.z(), 0);
}

// Wall and layer turn together, far and fast, without inertia: nothing is spent.
TEST(Walls, RigidTurnCostsNothing) {
  State s = resting(0.1);
  Model m;
  m.viscosity = 3;
  m.inertia = false;
  m.walls.push_back(floor_of(s));
  const Vector3 axis = Vector3(0.2, -0.3, 1).normalized();
  constexpr double rate = 2;
  const auto turned = [=](double from, double to) -> Matrix3 {
    return Eigen::AngleAxisd(rate * (to - from), axis).toRotationMatrix();
  };
  m.walls[0].motion = [=](double from, double to) { return RigidMotion{turned(from, to), Vector3::Zero()}; };
  m.walls[0].velocity = [=](double, const Vector3& x) { return Vector3(rate * axis.cross(x)); };
  m.walls[0].nearest = [=](double t, const Vector3& x) {
    const Vector3 n = turned(0, t) * Vector3::UnitZ();
    return WallPoint{n.dot(x), n};
  };
  for (std::size_t v = 0; v < s.velocities.size(); ++v)
    s.velocities[v] = rate * axis.cross(s.positions[v]);
  const State start = s;
  StepOptions options;
  options.newton.tolerance = 1e-13;
  Stepper stepper(m, options);
  for (int k = 0; k < 20; ++k)
    (void)stepper.step(s, 0.02);
  const Matrix3 turn = turned(0, s.time);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    EXPECT_LT((s.positions[v] - turn * start.positions[v]).norm(), 1e-12);
}

// Between two walls what touches both keeps to their line.
TEST(Walls, ACornerHoldsALine) {
  State s = resting(0.1);
  Model m = heavy_layer();
  m.inertia = false;
  m.walls.push_back(floor_of(s));
  Wall side; // x <= 1 - 0.05: the sheet's end touches it
  side.nearest = [](double, const Vector3& x) { return WallPoint{1.05 - x.x(), -Vector3::UnitX()}; };
  m.walls.push_back(side);
  Stepper stepper(m, {});
  for (int k = 0; k < 5; ++k)
    (void)stepper.step(s, 0.01);
  double furthest = 0;
  for (const Vector3& x : s.positions)
    furthest = std::max(furthest, x.x());
  EXPECT_LT(furthest, 1.01);
  EXPECT_GT(furthest, 0.98);
}

// A fixed step in which liquid would pass edges is taken in parts.
TEST(Walls, StepsPassHalfAnEdgeAtMost) {
  State s = resting(0.1);
  Model m = heavy_layer();
  m.walls.push_back(floor_of(s));
  m.walls[0].slip_length = free_slip; // or it stops at once
  for (Vector3& v : s.velocities)
    v = {10, 0, 0};
  Stepper stepper(m, {});
  EXPECT_GE(stepper.step(s, 0.1).substeps, 8); // edges of 0.2 and their diagonals
  EXPECT_DOUBLE_EQ(s.time, 0.1);
}

} // namespace
} // namespace sheet
