// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold to round-off: rigid motion costs nothing (V19), momentum is constant (V20), the result does not depend
// on the number of threads nor on the unit of length, and a failed step leaves the state alone.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/base/parallel.h"
#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// A dome with an uneven thickness.
State dome(int n) {
  test::Mesh mesh = test::rectangle(1, 1, n, n, 0.2);
  for (Vector3& x : mesh.positions)
    x.z() = 0.3 * std::sin(2 * x.x()) * std::cos(1.5 * x.y()) + 0.1 * x.x() * x.y();
  State s = test::at_rest(mesh, 0.05);
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    s.volumes[t] *= 1 + 0.5 * std::sin(static_cast<double>(t));
  return s;
}

Hold turning(const State& s, double rate) {
  Hold hold;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (s.positions[v].x() == 0)
      hold.vertices.push_back(v);
  test::move_steadily(hold, rate * Vector3(1, 2, -0.5).normalized(), {0.1, 0.2, 0.3});
  return hold;
}

TEST(RigidMotion, QuarterTurnInOneStepKeepsTheShape) {
  for (const Bending bending : {Bending::mid_edge, Bending::hinge})
    for (const bool arcs : {false, true})
      for (const Scheme scheme : {Scheme::sdirk2, Scheme::backward_euler}) {
        State s = dome(8);
        const State start = s;
        Model m;
        m.liquid.viscosity = 100;
        m.inertia = false;
        m.bending = bending;
        m.arcs = arcs;
        m.holds.push_back(turning(s, std::numbers::pi / 2));
        StepOptions options;
        options.scheme = scheme;
        Stepper stepper(m, options);
        EXPECT_EQ(stepper.step(s, 1).failed, 0);
        for (const Edge& e : s.mesh->edges) {
          const double before = (start.positions[e[0]] - start.positions[e[1]]).norm();
          EXPECT_NEAR((s.positions[e[0]] - s.positions[e[1]]).norm(), before, 1e-12 * before);
        }
      }
}

TEST(Momentum, IsConstantWithoutOutsideForces) {
  State s = dome(10);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    s.velocities[v] = {std::sin(3 * s.positions[v].y()), s.positions[v].z(), 1};
  Model m;
  m.liquid.viscosity = 10;
  m.liquid.density = 1000;
  m.liquid.surface_tension = 1;
  m.bending = Bending::mid_edge;
  const auto momenta = [&] {
    Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
    for (std::size_t t = 0; t < s.volumes.size(); ++t)
      for (const auto v : s.mesh->triangles[t]) {
        const Vector3 p = m.liquid.density * s.volumes[t] / 3 * s.velocities[v];
        linear += p;
        angular += s.positions[v].cross(p);
      }
    return std::pair{linear, angular};
  };
  const auto before = momenta();
  StepOptions options;
  options.newton.tolerance = 1e-10;
  Stepper stepper(m, options);
  for (int k = 0; k < 10; ++k)
    stepper.step(s, 0.01);
  const auto after = momenta();
  EXPECT_LE((after.first - before.first).norm(), 1e-12 * before.first.norm());
  // Angular momentum is conserved up to the scheme's error only.
  std::printf("V20 angular momentum changed by %.3e relative\n",
              (after.second - before.second).norm() / before.second.norm());
}

Model sagging() {
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.liquid.surface_tension = 0.1;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  return m;
}

TEST(Threads, SameBits) {
  std::vector<State> end;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    State s = dome(20);
    Model m = sagging();
    m.holds.push_back(turning(s, 0.5));
    Stepper stepper(m, {});
    for (int k = 0; k < 3; ++k)
      stepper.step(s, 0.01);
    end.push_back(s);
  }
  EXPECT_EQ(end[0].positions, end[1].positions);
  EXPECT_EQ(end[0].velocities, end[1].velocities);
}

// The same dimensionless scene in micrometres and in kilometres: lengths times l, viscosity kept, times kept, so that
// density ~ 1/l², gravity ~ l, surface tension ~ l.
TEST(Units, MicrometresAndKilometres) {
  std::vector<std::vector<Vector3>> shapes;
  std::vector<int> iterations;
  for (const double l : {1.0, 1e-6, 1e3}) {
    State s = dome(12);
    Model m = sagging();
    m.holds.push_back(turning(s, 0));
    test::move_steadily(m.holds[0], Vector3::Zero());
    for (Vector3& x : s.positions)
      x *= l;
    for (double& v : s.volumes)
      v *= l * l * l;
    m.liquid.density /= l * l;
    m.gravity *= l;
    m.liquid.surface_tension *= l;
    Stepper stepper(m, {});
    int count = 0;
    for (int k = 0; k < 5; ++k)
      count += stepper.step(s, 0.02).newton.iterations;
    for (Vector3& x : s.positions)
      x /= l;
    shapes.push_back(s.positions);
    iterations.push_back(count);
  }
  for (int k : {1, 2}) {
    double difference = 0;
    for (std::size_t v = 0; v < shapes[0].size(); ++v)
      difference = std::max(difference, (shapes[k][v] - shapes[0][v]).norm());
    std::printf("scaled scene: difference %.2e, Newton iterations %d and %d\n", difference, iterations[k],
                iterations[0]);
    EXPECT_LE(difference, 1e-9);
    EXPECT_EQ(iterations[k], iterations[0]);
  }
}

TEST(Failure, LeavesTheStateAlone) {
  State s = dome(6);
  Model m = sagging();
  m.holds.push_back(turning(s, 1));
  const State before = s;
  StepOptions options;
  options.newton.iterations = 1;
  options.newton.tolerance = 1e-15;
  options.retries = 2;
  Stepper stepper(m, options);
  try {
    stepper.step(s, 1);
    FAIL() << "one Newton iteration cannot be enough";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::not_converged);
  }
  EXPECT_EQ(s.positions, before.positions);
  EXPECT_EQ(s.time, before.time);
}

TEST(Adaptive, LandsOnTheOutputTimeAndFollowsTheTolerance) {
  double last_steps = 0, last_error = 0;
  State reference = dome(8);
  Model m = sagging();
  m.holds.push_back(turning(reference, 0));
  const State start = reference;
  {
    Stepper stepper(m, {});
    for (int k = 0; k < 400; ++k)
      stepper.step(reference, 0.2 / 400);
  }
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    State s = start;
    Stepper stepper(m, {});
    StepControl control{tolerance, 0};
    int steps = 0;
    while (s.time < 0.2) {
      stepper.step_within(s, s.time < 0.1 ? 0.1 : 0.2, control);
      ++steps;
    }
    EXPECT_EQ(s.time, 0.2);
    double error = 0;
    for (std::size_t v = 0; v < s.positions.size(); ++v)
      error = std::max(error, (s.positions[v] - reference.positions[v]).norm() * 8);
    std::printf("tolerance %.0e: %d steps, error %.2e edges\n", tolerance, steps, error);
    if (last_steps > 0) {
      EXPECT_GT(steps, last_steps);
      EXPECT_LT(error, last_error);
    }
    last_steps = steps;
    last_error = error;
  }
}

} // namespace
} // namespace sheet
