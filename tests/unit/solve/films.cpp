// SPDX-License-Identifier: GPL-3.0-or-later
// Films that tension draws together faster than a step resolves (energy/films.h).
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "libsheet/energy/films.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/geometry/area.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

Model liquid() {
  Model m;
  m.arcs = true;
  m.liquid.viscosity = 5;
  m.liquid.density = 1300;
  m.liquid.surface_tension = 0.05;
  m.bending = Bending::mid_edge;
  return m;
}

// 40 mm square, 2 mm thick, but `part` of that along one side.
State with_film(double part) {
  State s = test::at_rest(test::rectangle(0.04, 0.04, 10, 10, 0.2), 0.002);
  const auto at_the_side = [](const Vector3& x) { return x.x() > 0.025; };
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    if (std::ranges::all_of(s.mesh->triangles[t], [&](auto v) { return at_the_side(s.positions[v]); }))
      s.volumes[t] *= part;
  return s;
}

std::vector<double> areas(const State& s) {
  std::vector<double> result;
  for (const Corners& c : s.mesh->triangles)
    result.push_back(TriangleArea(s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]).area);
  return result;
}

std::vector<double> stiffened(const State& s, double dt) {
  return stiffened_films(first_stage(s, liquid().liquid, dt, dt, false), true);
}

// Two triangles folded onto each other, which the step is predicted to open on the other side: the mean of their
// normals turns over, and the director between them stays where it is.
TEST(FlatFolds, DirectorsDoNotTurnOver) {
  test::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.001}, {0.5, 1, -0.001}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  State s = test::at_rest(mesh, 0.01);
  for (const double speed : {0.0, 0.05}) {
    s.velocities[2] = {0, 0, -speed};
    s.velocities[3] = {0, 0, speed};
    const Stage stage = first_stage(s, Liquid{.viscosity = 1}, 0.05, 0.05, true);
    Unknowns u = stage.begin;
    for (std::size_t v = 0; v < 4; ++v)
      u.segment<3>(static_cast<Eigen::Index>(3 * v)) = stage.predicted[v];
    turn_with_normals(stage, u);
    EXPECT_LT(u.tail(static_cast<Eigen::Index>(s.mesh->edges.size())).cwiseAbs().maxCoeff(), 0.1) << speed;
  }
}

// μ h/(4 γ) is 0.5 s in the sheet.
TEST(Films, AreStiffenedWhereStepsDoNotResolveThem) {
  EXPECT_TRUE(stiffened(with_film(1), 0.01).empty());
  EXPECT_TRUE(stiffened(with_film(0.2), 10).empty()); // no film
  EXPECT_TRUE(stiffened(with_film(1e-3), 1e-6).empty());
  for (const double part : {1e-4, 1e-8}) {
    const State s = with_film(part);
    const std::vector<double> raised = stiffened(s, 0.01), area = areas(s);
    ASSERT_EQ(raised.size(), s.volumes.size());
    for (std::size_t t = 0; t < raised.size(); ++t) {
      const double h = s.volumes[t] / area[t];
      if (h > 1e-3)
        EXPECT_EQ(raised[t], 1);
      else
        EXPECT_NEAR(raised[t] * liquid().liquid.viscosity * h / 4 / 0.01, 2 * liquid().liquid.surface_tension, 0.01)
            << part; // less near the greatest
    }
  }
}

// Triangles at that side of all thicknesses from `part` of the sheet's on, next to each other.
State with_uneven_film(double part) {
  State s = with_film(1);
  const State film = with_film(part);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    s.volumes[t] *= std::pow(film.volumes[t] / s.volumes[t], uniform(random));
  return s;
}

TEST(Films, StepsLongerThanTheyTakeToContractNeedFewIterations) {
  for (const double part : {1e-3, 1e-5, 1e-8})
    for (const double dt : {1e-3, 1e-2}) {
      State s = with_uneven_film(part);
      Stepper stepper(liquid(), {});
      int spent = 0;
      for (int k = 0; k < 3; ++k) {
        const std::vector<double> before = areas(s);
        const StepReport r = stepper.step(s, dt);
        EXPECT_EQ(r.failed, 0) << part << " " << dt;
        spent += r.newton.spent();
        const std::vector<double> after = areas(s);
        for (std::size_t t = 0; t < before.size(); ++t)
          EXPECT_GE(after[t], 0.3 * before[t]) << part << " " << dt;
      }
      EXPECT_LE(spent, 24) << part << " " << dt;
    }
}

// A crumb beside a square, thicker than its edges are long, whose corners move against each other. With rims that
// tension makes round it is a thread, and its motion is followed.
TEST(Films, CrumbsRuleNoStepUnlessRimsAreRound) {
  const auto first_step = [](bool crumb, bool round) {
    test::Mesh mesh = test::rectangle(0.04, 0.04, 10, 10, 0.2);
    const std::size_t own = mesh.positions.size();
    if (crumb) {
      const auto first = static_cast<std::uint32_t>(own);
      const test::Mesh strip = test::rectangle(2e-3, 5e-4, 4, 1, 0);
      for (const Vector3& x : strip.positions)
        mesh.positions.emplace_back(x + Vector3(0.1, 0, 0));
      for (const Corners& c : strip.triangles)
        mesh.triangles.push_back({first + c[0], first + c[1], first + c[2]});
    }
    State s = test::at_rest(mesh, 0.002);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-0.05, 0.05);
    for (std::size_t v = own; v < s.velocities.size(); ++v)
      s.velocities[v] = {any(random), any(random), any(random)};
    Model m = liquid();
    m.gravity = {0, 0, -9.81};
    if (round)
      m.faces.emplace();
    StepControl control{1e-2, 0};
    const StepReport r = Stepper(m, {}).step_within(s, 0.1, control);
    EXPECT_EQ(r.inaccurate + r.unfinished, 0);
    return s.time;
  };
  const double without = first_step(false, false);
  EXPECT_NEAR(first_step(true, false), without, 0.01 * without);
  EXPECT_LT(first_step(true, true), 0.9 * without);
}

} // namespace
} // namespace sheet
