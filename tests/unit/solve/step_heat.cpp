// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures through time steps: losses of faces, walls and layers that cover them, viscous heating, accounts.
#include "libsheet/solve/step_heat.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double film_height = 0.01, capacity = 2e6, hot = 400, cold = 300;

State resting_film() {
  State s = test::at_rest(test::rectangle(1, 1, 4, 4, 0), film_height);
  s.temperatures.assign(s.volumes.size(), hot);
  return s;
}

Model film_model() {
  Model m;
  m.liquid = {.viscosity = 100, .density = 1000};
  m.heat = HeatModel{.capacity = capacity};
  return m;
}

double warmth(const State& s) {
  double sum = 0;
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    sum += s.volumes[t] * s.temperatures[t];
  return sum;
}

State cooled(const Model& model, double time, int count) {
  State s = resting_film();
  Stepper stepper(model, {});
  for (int k = 0; k < count; ++k)
    (void)stepper.step(s, time / count);
  return s;
}

TEST(StepHeat, FacesCoolItLumped) {
  Model m = film_model();
  m.heat->surroundings = {heat::Surroundings{.transfer = 150, .ambient = cold}, {.transfer = 50, .ambient = cold}};
  const double time = capacity * film_height / 200;
  double error[2] = {};
  for (const int fine : {0, 1}) {
    const State s = cooled(m, time, fine == 0 ? 8 : 16);
    error[fine] = std::abs(s.temperatures[5] - cold - (hot - cold) * std::exp(-1));
    EXPECT_NEAR(s.heat_moved.upper, 3 * s.heat_moved.lower, 1e-9 * s.heat_moved.upper);
    EXPECT_NEAR(capacity * (hot * film_height - warmth(s)), s.heat_moved.upper + s.heat_moved.lower, 1e-6);
  }
  EXPECT_LT(error[1], 0.05);
  EXPECT_GT(std::log2(error[0] / error[1]), 1.9);
}

// A film that flies at U through air whose temperature rises by G a metre and R a second comes to T_a - (G U + R) t_c.
TEST(StepHeat, SurroundingsMayDependOnTimeAndPlace) {
  constexpr double speed = 2, gradient = 30, rise = -20, tc = capacity * film_height / 200;
  Model m = film_model();
  const auto around = [](double t, const Vector3& x) {
    return heat::Surroundings{.transfer = 150, .ambient = cold + gradient * x.x() + rise * t};
  };
  m.heat->local_surroundings[heat::upper] = around;
  m.heat->surroundings[heat::lower] = {.transfer = 50, .ambient = cold};
  double before = 0;
  for (const int count : {8, 16, 32}) {
    State s = resting_film();
    for (Vector3& v : s.velocities)
      v = speed * Vector3::UnitX();
    const Corners c = s.mesh->triangles[5];
    const double start = (s.positions[c[0]] + s.positions[c[1]] + s.positions[c[2]]).x() / 3;
    Stepper stepper(m, {});
    for (int k = 0; k < count; ++k)
      (void)stepper.step(s, tc / count);
    // T' = (a + b t - T)/t_c, by the mean of what both faces have; here at t = t_c.
    const double a = cold + 0.75 * gradient * start, b = 0.75 * (gradient * speed + rise);
    const double exact = a + (hot - a + b * tc) * std::exp(-1);
    const double error = std::abs(s.temperatures[5] - exact);
    if (before > 0) {
      EXPECT_GT(std::log2(before / error), 1.9) << count;
    }
    before = error;
    EXPECT_NEAR(capacity * (hot * film_height - warmth(s)), s.heat_moved.upper + s.heat_moved.lower, 1e-6);
  }
  EXPECT_LT(before, 0.3);
}

// The face that lies on a wall sees nothing else.
TEST(StepHeat, AWallTakesTheHeatOfTheFaceThatLiesOnIt) {
  for (const double side : {1.0, -1.0}) { // of the normal out of the wall
    Model m = film_model();
    m.heat->surroundings = {heat::Surroundings{.transfer = 30, .ambient = cold}, {.transfer = 70, .ambient = cold}};
    WarmWall wall;
    wall.conductance = 200;
    for (std::uint32_t v = 0; v < resting_film().positions.size(); ++v)
      wall.vertices.push_back(v);
    wall.temperature = [](double) { return cold; };
    wall.normal = [=](double, const Vector3&) -> Vector3 { return side * Vector3::UnitZ(); };
    m.heat->walls = {wall};
    const double free = side > 0 ? 30 : 70; // on its positive side, the lower face lies on the wall
    const State s = cooled(m, capacity * film_height / (200 + free), 50);
    EXPECT_NEAR(s.temperatures[5], cold + (hot - cold) * std::exp(-1), 0.01);
    EXPECT_NEAR(s.heat_moved.solids / (s.heat_moved.upper + s.heat_moved.lower), 200 / free, 1e-9);
    EXPECT_EQ(side > 0 ? s.heat_moved.lower : s.heat_moved.upper, 0);
  }
}

// What another layer lies on loses nothing there.
TEST(StepHeat, LayersCoverEachOther) {
  Model m = film_model();
  m.heat->surroundings = {heat::Surroundings{.transfer = 30, .ambient = cold}, {.transfer = 70, .ambient = cold}};
  const State start = resting_film();
  for (std::uint32_t v = 3; v < start.positions.size(); ++v) { // as if those three lay below all others
    ContactSpring spring;
    spring.vertices = {v, 0, 1, 2};
    spring.weights = {1, -1.0 / 3, -1.0 / 3, -1.0 / 3};
    spring.normal = Vector3::UnitZ();
    m.contacts.push_back(spring);
  }
  Stepper stepper(m, {});
  State s = start;
  (void)stepper.step(s, 1);
  const std::size_t last = s.volumes.size() - 1; // far from the first three
  EXPECT_NEAR(hot - s.temperatures[last], 30 * (hot - cold) / (capacity * film_height), 2e-4); // it cools on the way
}

// A film that is pulled at a given rate: 4 μ ε̇² of each cubic metre [Trouton 1906, of a sheet whose width is held].
TEST(StepHeat, DissipationBecomesHeat) {
  for (const bool arcs : {false, true}) {
    Model m = film_model();
    m.heat->viscous = true;
    m.bending = arcs ? Bending::mid_edge : Bending::none;
    m.arcs = arcs;
    State s = resting_film();
    for (std::size_t v = 0; v < s.positions.size(); ++v)
      s.velocities[v].x() = 2 * s.positions[v].x();
    m.liquid.density = 1e9; // it goes on as it moves
    Stepper stepper(m, {});
    const double time = 1e-3, before = warmth(s);
    (void)stepper.step(s, time);
    const double power = capacity * (warmth(s) - before) / time;
    EXPECT_NEAR(power, 4 * 100 * 4 * film_height, 0.01 * 16) << arcs;
    EXPECT_NEAR(s.heat_moved.generated, capacity * (warmth(s) - before), 1e-14 * capacity * before);
  }
}

TEST(StepHeat, ModesOfTheThicknessAreKept) {
  Model m = film_model();
  m.heat->conductivity = 1;
  m.heat->surroundings = {heat::Surroundings{.transfer = 600, .ambient = cold}, {.transfer = 600, .ambient = cold}};
  m.liquid.temperature_law = {
      .kind = TemperatureLawKind::exponential, .reference_temperature = hot, .temperature_coefficient = 0.05};
  double means[3] = {};
  for (int k = 0; k < 3; ++k) { // Bi = 3
    m.heat->profile = k == 0 ? heat::even_modes(3) : k == 1 ? heat::parabola() : heat::uniform_profile();
    const State s = cooled(m, 10, 20);
    EXPECT_EQ(s.temperature_modes.size(), (k == 2 ? 0U : 2U) * s.volumes.size());
    means[k] = s.temperatures[5];
    if (k < 2) {
      EXPECT_LT(s.temperature_modes[k == 0 ? 0 : 1], 0); // P_2: colder at the faces
    }
  }
  EXPECT_GT(means[1], means[2] + 1); // cold faces lose less
  EXPECT_GT(means[0], means[2] + 1);
}

} // namespace
} // namespace sheet
