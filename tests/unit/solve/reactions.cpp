// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of holds at the end of a step.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

struct Grip {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero(); // [N], about the strip's middle [N m]
};

// A strip that sags between two clamps, one of which pulls and twists it: what that one does to it after 0.2 s, in so
// many steps.
Grip pulled_and_twisted(int steps) {
  constexpr double length = 0.1, time = 0.2;
  State s = test::at_rest(test::rectangle(length, 0.02, 20, 4, 0.2), 0.002);
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.density = 1000;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.arcs = true;
  m.reactions = Reactions::at_end;
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
    grip.force += report.reactions[v];
    grip.moment += (s.positions[v] - Vector3(length / 2, 0.01, 0)).cross(report.reactions[v]);
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

} // namespace
} // namespace sheet
