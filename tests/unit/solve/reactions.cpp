// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of holds at the end of a step, and in its last stage.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

Model that_sags(Reactions reactions) {
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.arcs = true;
  m.reactions = reactions;
  return m;
}

struct Grip {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero(); // [N], about the strip's middle [N m]
};

// A strip that sags between two clamps, one of which pulls and twists it: what that one does to it after 0.2 s, in so
// many steps.
Grip pulled_and_twisted(int steps) {
  constexpr double length = 0.1, time = 0.2;
  State s = test::at_rest(test::rectangle(length, 0.02, 20, 4, 0.2), 0.002);
  Model m = that_sags(Reactions::at_end);
  m.holds.resize(2);
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    for (const std::size_t end : {0, 1})
      if (s.positions[v].x() == static_cast<double>(end) * length)
        m.holds[end].vertices.push_back(v);
  for (std::uint32_t e = 0; e < s.mesh->edges.size(); ++e)
    for (const std::size_t end : {0, 1})
      if (s.positions[s.mesh->edges[e][0]].x() == static_cast<double>(end) * length &&
          s.positions[s.mesh->edges[e][1]].x() == static_cast<double>(end) * length)
        m.holds[end].clamped_edges.push_back(e);
  test::move_steadily(m.holds[1], {2, 0, 0}, {0.02, 0, 0});
  Stepper stepper(m, {});
  StepReport report;
  for (int k = 0; k < steps; ++k)
    report = stepper.step(s, time / steps);
  Grip grip;
  for (const auto v : m.holds[1].vertices) {
    grip.force += report.reactions.all[v];
    grip.moment += (s.positions[v] - Vector3(length / 2, 0.01, 0)).cross(report.reactions.all[v]);
  }
  return grip;
}

TEST(EndReactions, AreOfSecondOrder) {
  const Grip exact = pulled_and_twisted(960);
  const auto errors = [&](int steps) {
    const Grip grip = pulled_and_twisted(steps);
    return std::array{(grip.force - exact.force).norm() / exact.force.norm(),
                      (grip.moment - exact.moment).norm() / exact.moment.norm()};
  };
  const auto coarse = errors(20), fine = errors(120);
  for (const std::size_t k : {0, 1}) {
    EXPECT_LT(coarse[k], 0.005);
    EXPECT_GT(std::log(coarse[k] / fine[k]) / std::log(6.0), 1.9);
  }
}

// A strip between two clamps begins to sag: each bears the weight of its vertices, and, besides, what the strip between
// them hangs on it with.
TEST(StageReactions, OfExternalForcesAreTheWeightOfWhatIsHeld) {
  State s = test::at_rest(test::rectangle(0.1, 0.02, 20, 4, 0.2), 0.002);
  Model m = that_sags(Reactions::of_stage);
  m.external_reactions = true;
  m.holds.resize(1);
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    if (s.positions[v].x() == 0 || s.positions[v].x() == 0.1)
      m.holds[0].vertices.push_back(v);
  const double volume = std::accumulate(s.volumes.begin(), s.volumes.end(), 0.0);
  std::vector<double> mass(s.positions.size(), 0);
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    for (const std::uint32_t v : s.mesh->triangles[t])
      mass[v] += 1000 * s.volumes[t] / 3;
  StepReport report;
  Stepper stepper(m, {});
  for (int k = 0; k < 10; ++k)
    report = stepper.step(s, 0.01);
  ASSERT_EQ(report.reactions.external.size(), s.positions.size());
  double all = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const bool held = std::ranges::find(m.holds[0].vertices, v) != m.holds[0].vertices.end();
    const Vector3 weight = held ? Vector3(0, 0, 9.81 * mass[v]) : Vector3(0, 0, 0);
    EXPECT_LT((report.reactions.external[v] - weight).norm(), 1e-9 * 9.81 * mass[v]) << v;
    all += report.reactions.all[v].z();
  }
  EXPECT_GT(all, 0.8 * 9.81 * 1000 * volume); // all but what falls on
}

constexpr double gap = 0.01;

// Fills the gap between the plane z = 0, its first wall, and one at the height gap (1 - t closing) that moves along x.
Model between_walls(const State& s, double closing, double speed) {
  Model m;
  m.liquid.viscosity = 2;
  m.bending = Bending::none;
  m.reactions = Reactions::at_end;
  m.walls.resize(2);
  m.walls[0].vertices.resize(s.positions.size());
  std::iota(m.walls[0].vertices.begin(), m.walls[0].vertices.end(), 0);
  m.walls[0].solid = 4;
  m.walls[0].nearest = [](double, const Vector3& x) { return WallPoint{x.z(), Vector3::UnitZ()}; };
  m.walls[1].solid = 7;
  m.walls[1].nearest = [=](double t, const Vector3& x) {
    return WallPoint{gap * (1 - t * closing) - x.z(), -Vector3::UnitZ()};
  };
  m.walls[1].motion = [=](double from, double to) {
    return RigidMotion{Matrix3::Identity(), (to - from) * Vector3(speed, 0, -gap * closing)};
  };
  m.walls[1].velocity = [=](double, const Vector3&) { return Vector3(speed, 0, -gap * closing); };
  return m;
}

struct OfBoth {
  Vector3 first = Vector3::Zero(), second = Vector3::Zero(); // of each wall on the layer [N]
};

OfBoth forces_after(State s, const Model& m, double duration, int steps) {
  StepReport report;
  Stepper stepper(m, {});
  for (int k = 0; k < steps; ++k)
    report = stepper.step(s, duration / steps);
  OfBoth sum;
  for (const Vector3& force : report.reactions.all)
    sum.first += force;
  for (const auto& [solid, force] : report.reactions.more)
    (solid == 4 ? sum.first : sum.second) += force;
  return sum;
}

// Round plates that close at the rate e: 3 π μ e R⁴/(2 g²) on each [Stefan 1874; Batchelor 1967, section 4.8].
TEST(EndReactions, OfPlatesThatCloseAreStefans) {
  constexpr double rate = 1, duration = 1e-3;
  State s = test::at_rest(test::disk(1, 12, 0.1), gap);
  for (Vector3& x : s.positions)
    x.z() = gap / 2;
  const double end_gap = gap * (1 - rate * duration);
  const OfBoth of = forces_after(s, between_walls(s, rate, 0), duration, 2);
  const double force = 1.5 * std::numbers::pi * 2 * rate / (end_gap * end_gap);
  EXPECT_NEAR(of.second.z() / force, -1, 0.02);
  EXPECT_NEAR(of.first.z() / force, 1, 0.02);
  EXPECT_LT((of.first + of.second).norm(), 1e-9 * force);
}

// A plate that slides over liquid which another holds back without slip, or with it: μ U A/(g + b).
TEST(EndReactions, OfPlatesThatSlideAreThoseOfShear) {
  for (const double slip : {0.0, gap / 2}) {
    State s = test::at_rest(test::rectangle(1, 0.5, 10, 5, 0.0), gap);
    for (Vector3& x : s.positions)
      x.z() = gap / 2;
    Model m = between_walls(s, 0, 3);
    m.walls[0].slip_length = slip;
    const OfBoth of = forces_after(s, m, 1e-3, 4);
    const double force = 2 * 3 * 0.5 / (gap + slip);
    EXPECT_LT((of.second - Vector3(force, 0, 0)).norm(), 1e-6 * force);
    EXPECT_LT((of.first + Vector3(force, 0, 0)).norm(), 1e-6 * force);
  }
}

// A wall pushes a layer along its floor: what it gives the layer, drag takes. The layer's weight is the floor's.
TEST(EndReactions, OfAPloughAreItsPush) {
  State s = test::at_rest(test::rectangle(1, 0.5, 20, 10, 0.1), 0.1);
  Model m;
  m.liquid.viscosity = 5;
  m.liquid.density = 100;
  m.inertia = false;
  m.gravity = {0, 0, -9};
  m.bending = Bending::none;
  m.reactions = Reactions::at_end;
  m.walls.resize(2);
  for (Vector3& x : s.positions)
    x.z() = 0.05;
  m.walls[0].vertices.resize(s.positions.size());
  std::iota(m.walls[0].vertices.begin(), m.walls[0].vertices.end(), 0);
  m.walls[0].nearest = [](double, const Vector3& x) { return WallPoint{x.z(), Vector3::UnitZ()}; };
  m.walls[1].solid = 3;
  m.walls[1].nearest = [](double t, const Vector3& x) { return WallPoint{x.x() + 0.04 - 0.1 * t, Vector3::UnitX()}; };
  m.walls[1].velocity = [](double, const Vector3&) { return Vector3(0.1, 0, 0); };
  StepReport report;
  Stepper stepper(m, {});
  for (int k = 0; k < 10; ++k)
    report = stepper.step(s, 0.05);
  std::array<Vector3, 4> of{Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  for (const Vector3& force : report.reactions.all)
    of[0] += force;
  for (const auto& [solid, force] : report.reactions.more)
    of[solid] += force;
  // At least the drag of what has gone 0.05 as fast as the wall: 3 μ U/h on so much of the floor.
  EXPECT_GT(of[3].x(), 3 * 5 * 0.1 / 0.1 * 0.05 * 0.5);
  EXPECT_LT((of[0] + of[3] - Vector3(0, 0, 100 * 9 * 0.05)).norm(), 1e-6 * of[3].x());
  EXPECT_NEAR(of[3].z(), 0, 1e-9 * of[3].x());
}

} // namespace
} // namespace sheet
