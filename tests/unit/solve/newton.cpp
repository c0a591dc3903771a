// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// A sheet that is thrown and falls.
State thrown(double speed) {
  test::Mesh mesh = test::rectangle(1, 1, 10, 10, 0.2);
  for (Vector3& x : mesh.positions)
    x.z() = 0.2 * std::sin(2 * x.x()) * std::cos(1.5 * x.y());
  State s = test::at_rest(mesh, 0.02);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    s.velocities[v] =
        speed * Vector3(std::sin(3 * s.positions[v].y()), s.positions[v].z(), std::cos(4 * s.positions[v].x()));
  return s;
}

Model syrup() {
  Model m;
  m.liquid.viscosity = 50;
  m.liquid.density = 1000;
  m.liquid.surface_tension = 0.1;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.arcs = true;
  return m;
}

NewtonReport step(State& s, double dt, double tolerance, const FlowLaw& law = {}) {
  StepOptions options;
  options.newton.tolerance = tolerance;
  Model m = syrup();
  m.liquid.law = law;
  const StepReport report = Stepper(std::move(m), options).step(s, dt);
  EXPECT_EQ(report.failed, 0);
  return report.newton;
}

double greatest_difference(const State& a, const State& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.positions.size(); ++v)
    most = std::max(most, (a.positions[v] - b.positions[v]).norm());
  return most;
}

TEST(Newton, FollowsTheFactorAloneWhileThatServes) {
  State s = thrown(0.5), exact = s;
  const NewtonReport report = step(s, 1e-3, 1e-5);
  EXPECT_EQ(report.products, 0);
  EXPECT_EQ(report.factorizations, 1);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_GE(report.followed, 1);
  (void)step(exact, 1e-3, 1e-11);
  EXPECT_LE(greatest_difference(s, exact), 1e-5 * 0.1);
}

// Of what is not Newtonian: each direction that the factor at hand does not give has a new one, and few products.
TEST(Newton, RenewsTheFactorWhereViscosityFollowsTheRate) {
  FlowLaw thins{.kind = FlowLawKind::power, .flow_index = 0.5}, yields{.kind = FlowLawKind::bingham};
  yields.yield_stress = 30;
  for (const FlowLaw& law : {thins, yields}) {
    State s = thrown(0.5), exact = s;
    const NewtonReport report = step(s, 1e-2, 1e-5, law);
    EXPECT_GE(report.iterations, 1);
    EXPECT_GE(report.factorizations, report.iterations);
    EXPECT_LE(report.products, 4 * report.iterations);
    (void)step(exact, 1e-2, 1e-11, law);
    EXPECT_LE(greatest_difference(s, exact), 1e-5 * 0.1);
  }
}

TEST(Newton, TurnsToTheHessianWhereTheFactorServesNoMore) {
  State s = thrown(5), exact = s;
  const NewtonReport report = step(s, 1e-2, 1e-5);
  EXPECT_GT(report.products, 0);
  (void)step(exact, 1e-2, 1e-11);
  EXPECT_LE(greatest_difference(s, exact), 1e-5 * 0.1);
}

// A thin film that is pressed together buckles within its triangles: what is soft at one stage is stiff at the next,
// and a factor of one misleads at the other.
TEST(Newton, LeavesAFactorThatMisleads) {
  test::Mesh mesh = test::rectangle(1, 1, 16, 16, 0.2);
  State s = test::at_rest(mesh, 0.005);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    s.velocities[v] = {-s.positions[v].x(), 0, 0.01 * std::sin(9 * s.positions[v].x() + 5 * s.positions[v].y())};
  Stepper stepper(syrup(), {});
  NewtonReport all;
  for (int i = 0; i < 10; ++i) {
    const StepReport report = stepper.step(s, 0.01);
    EXPECT_EQ(report.failed, 0);
    all += report.newton;
  }
  EXPECT_LE(all.iterations, 28); // 37 with misleading factors, 20 without
  EXPECT_LE(all.products, 60);   // 111, 31
}

} // namespace
} // namespace sheet
