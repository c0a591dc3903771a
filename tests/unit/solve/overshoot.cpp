// SPDX-License-Identifier: GPL-3.0-or-later
// What the sheet makes of vertices that a solid has caught and put back: it gets the displacement that it lacks.
#include "libsheet/energy/overshoot.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// A strip, 0.8 m x 0.2 m, held at both ends; those at x = 0.8 m stand `by` beyond where they are held.
struct Strip {
  State state;
  Model model;
  std::vector<Vector3> by;

  explicit Strip(const Vector3& overshoot, double density = 0) : state(test::at_rest(mesh(), 0.02)) {
    Hold hold;
    by.assign(state.positions.size(), Vector3::Zero());
    for (std::uint32_t v = 0; v < state.positions.size(); ++v) {
      const double x = state.positions[v].x();
      if (x != 0 && x != 0.8)
        continue;
      hold.vertices.push_back(v);
      if (x != 0)
        by[v] = overshoot;
    }
    model.liquid.viscosity = 100;
    model.liquid.density = density;
    model.inertia = density > 0;
    model.bending = Bending::mid_edge;
    model.holds.push_back(hold);
  }
  static test::Mesh mesh() { return test::rectangle(0.8, 0.2, 16, 4, 0.2); }
  void make_up_within(double time) {
    std::vector<Overshoot> all;
    for (const Vector3& way : by)
      all.push_back({way, time});
    make_up_for(state, std::move(all));
  }
};

double farthest(const State& a, const State& b) {
  double most = 0;
  for (std::size_t v = 0; v < a.positions.size(); ++v)
    most = std::max(most, (a.positions[v] - b.positions[v]).norm());
  return most;
}

double fastest(const State& s) {
  double most = 0;
  for (const Vector3& v : s.velocities)
    most = std::max(most, v.norm());
  return most;
}

// Without inertia a way leads where it leads, however it is gone: to where the sheet would be had its end been moved
// back by a [[hold]], but for the square of the way. And all is at rest then.
TEST(Overshoot, IsMadeUpForInOneStep) {
  std::vector<double> off;
  for (const double way : {4e-4, 2e-4}) {
    Strip strip({-way, 0, -0.5 * way});
    State moved = strip.state;
    for (std::size_t v = 0; v < moved.positions.size(); ++v)
      moved.positions[v] += strip.by[v];
    strip.make_up_within(1);
    ASSERT_EQ(strip.state.to_make_up.size(), strip.by.size());
    EXPECT_EQ(farthest(put_back(strip.state, 1), moved), 0);

    Model pulled = strip.model;
    Hold end;
    for (const std::uint32_t v : pulled.holds[0].vertices)
      if (!strip.by[v].isZero(0))
        end.vertices.push_back(v);
    test::move_steadily(end, Vector3::Zero(), Vector3(way, 0, 0.5 * way));
    pulled.holds.push_back(end);
    Stepper(pulled, {}).step(moved, 1);

    const State before = strip.state;
    Stepper(strip.model, {}).step(strip.state, 1);
    EXPECT_TRUE(strip.state.to_make_up.empty());
    EXPECT_GT(farthest(strip.state, before), 0.1 * way);
    for (std::size_t v = 0; v < strip.by.size(); ++v)
      if (!strip.by[v].isZero(0)) {
        EXPECT_LT((strip.state.positions[v] - before.positions[v]).norm(), 1e-15);
      }
    EXPECT_LT(fastest(strip.state), 0.02 * way) << way;
    off.push_back(farthest(strip.state, moved));
    EXPECT_LT(off.back(), 0.03 * way) << way;
  }
  EXPECT_LT(off[1], 0.3 * off[0]); // the square
}

// A chosen step is not shortened for it: what is left of the estimate goes as the square of the way, down to the tenth
// to which the response is known.
TEST(Overshoot, IsNoErrorOfTheStep) {
  for (const double density : {0.0, 1000.0}) {
    std::vector<double> errors;
    for (const double way : {4e-4, 2e-4, 1e-4}) {
      Strip strip({-way, 0, -0.5 * way}, density);
      strip.make_up_within(0.1);
      StepControl control{.tolerance = 1, .dt = 0.1};
      const StepReport report = Stepper(strip.model, {}).step_within(strip.state, 0.1, control);
      EXPECT_EQ(report.rejected, 0);
      errors.push_back(report.error);
    }
    EXPECT_LT(errors[2], 0.1 * 1e-4 / 0.05) << density; // edges of 5 cm
    EXPECT_LT(errors[1], 0.4 * errors[0]) << density;
  }
}

// What is too much for a step of any length is given up: the step is the one that it would have been without it.
TEST(Overshoot, DoesNotStallChosenSteps) {
  Strip with({-0.02, 0, -0.01}, 1000), without({-0.02, 0, -0.01}, 1000);
  with.make_up_within(1e-9);
  ASSERT_FALSE(with.state.to_make_up.empty());
  for (Strip* strip : {&with, &without}) {
    for (std::size_t v = 0; v < strip->by.size(); ++v) // the sheet swings, so that a step has an error
      strip->state.velocities[v].z() = std::sin(20 * strip->state.positions[v].x());
    StepControl control{.tolerance = 1e-3, .dt = 0.1};
    const StepReport report = Stepper(strip->model, {}).step_within(strip->state, 0.1, control);
    EXPECT_LE(report.error, 1e-3);
    EXPECT_EQ(report.inaccurate, 0);
  }
  EXPECT_EQ(with.state.time, without.state.time);
}

// Where the way is longer than triangles are wide, vertices stay where they are held.
TEST(Overshoot, TurnsNoTriangleRound) {
  for (const Vector3& way : {Vector3(-0.06, 0, 0), Vector3(0.2, 0, 0), Vector3(0, 0, 0.2)}) {
    Strip strip(way);
    const State before = strip.state;
    strip.make_up_within(1);
    EXPECT_TRUE(strip.state.to_make_up.empty());
    EXPECT_EQ(farthest(strip.state, before), 0);
  }
  // However far, where all go: nothing is strained.
  Strip strip({0.01, 0, 0});
  strip.by.assign(strip.by.size(), Vector3(10, 0, 0));
  strip.make_up_within(1);
  EXPECT_EQ(strip.state.to_make_up.size(), strip.by.size());
  forget_overshoot(strip.state);
  EXPECT_TRUE(strip.state.to_make_up.empty());
  EXPECT_EQ(farthest(put_back(strip.state, 1), Strip({0.01, 0, 0}).state), 0);
}

// Shorter steps than that in which it was caught make up for it in the same time, all together: without inertia for the
// same way as that one, whatever the number of steps. With inertia they give what is beside it no more speed than it
// came with, however short they are: all of it in the first one, 30 steps of a thousandth gave 100 times that.
TEST(Overshoot, IsMadeUpForNoFasterThanItCame) {
  constexpr double way = 2e-4, time = 0.1;
  Strip at_once({-way, 0, 0});
  at_once.make_up_within(time);
  Stepper(at_once.model, {}).step(at_once.state, time);
  for (const int steps : {7, 100}) {
    Strip strip({-way, 0, 0});
    const State before = strip.state;
    strip.make_up_within(time);
    Stepper stepper(strip.model, {});
    for (int i = 0; i < steps; ++i) {
      EXPECT_FALSE(strip.state.to_make_up.empty());
      const std::vector<Vector3> start = strip.state.positions;
      stepper.step(strip.state, time / steps);
      for (std::size_t v = 0; v < start.size(); ++v)
        EXPECT_LT((strip.state.positions[v] - start[v]).norm(), 1.1 * way / steps);
    }
    EXPECT_TRUE(strip.state.to_make_up.empty());
    EXPECT_GT(farthest(strip.state, before), 0.1 * way);
    EXPECT_LT(farthest(strip.state, at_once.state), 0.03 * way);
  }
  Strip heavy({-way, 0, 0}, 1000);
  heavy.make_up_within(time);
  Stepper stepper(heavy.model, {});
  for (int i = 0; i < 30; ++i) {
    stepper.step(heavy.state, 1e-3 * time);
    EXPECT_LT(fastest(heavy.state), way / time);
  }
}

} // namespace
} // namespace sheet
