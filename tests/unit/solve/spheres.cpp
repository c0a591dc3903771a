// SPDX-License-Identifier: GPL-3.0-or-later
// Spheres with exact solutions (VALIDATION.md): V1 balloon under constant pressure, V2 under p ~ 1/r², V3 inviscid
// contraction under surface tension. Time orders are measured against a fine step on the same mesh, errors against the
// formula.
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

double mean_radius(const State& s) {
  double r = 0;
  for (const Vector3& x : s.positions)
    r += x.norm();
  return r / static_cast<double>(s.positions.size());
}

// A sphere of unit radius whose triangles together hold the volume of the exact sphere's film.
State sphere(int level, double thickness) {
  State s = test::at_rest(test::icosphere(level), thickness);
  return s;
}

double run(const Model& model, Scheme scheme, State s, double until, int steps,
           Thickness thickness = Thickness::coupled) {
  StepOptions options;
  options.scheme = scheme;
  options.thickness = thickness;
  Stepper stepper(model, options);
  int iterations = 0;
  for (int k = 0; k < steps; ++k) {
    const StepReport r = stepper.step(s, until / steps);
    iterations += r.newton.iterations;
    EXPECT_EQ(r.failed, 0);
    EXPECT_TRUE(r.newton.monotone);
  }
  ::testing::Test::RecordProperty("newton_iterations", iterations);
  return mean_radius(s);
}

double order(double coarse, double middle, double fine) {
  return std::log2(std::abs(coarse - middle) / std::abs(middle - fine));
}

Model balloon(PressureLaw::Kind kind) {
  Model m;
  m.viscosity = 0.1;
  m.inertia = false;
  m.pressure = PressureLaw{kind, 0.1, 1, 1};
  return m;
}

TEST(Balloon, TimeOrderConstantPressure) {
  const Model m = balloon(PressureLaw::Kind::constant);
  const double until = 0.8 * 4 * 0.1 * 0.1 / 0.1;
  const double exact = std::pow(1 - 0.8, -1.0 / 3);
  for (const auto& [scheme, least] : {std::pair{Scheme::sdirk2, 1.9}, std::pair{Scheme::backward_euler, 0.8}}) {
    double r[3];
    for (int k = 0; k < 3; ++k)
      r[k] = run(m, scheme, sphere(2, 0.1), until, 20 << k);
    std::printf("V1 level 2 %s: r %.6f %.6f %.6f exact %.6f order %.3f\n", scheme == Scheme::sdirk2 ? "sdirk2" : "BE",
                r[0], r[1], r[2], exact, order(r[0], r[1], r[2]));
    EXPECT_GE(order(r[0], r[1], r[2]), least);
  }
}

TEST(Balloon, SpaceConstantPressure) {
  const Model m = balloon(PressureLaw::Kind::constant);
  const double until = 0.8 * 4 * 0.1 * 0.1 / 0.1;
  const double exact = std::pow(1 - 0.8, -1.0 / 3);
  double e[3];
  for (int l = 1; l <= 3; ++l) {
    e[l - 1] = run(m, Scheme::sdirk2, sphere(l, 0.1), until, 80) / exact - 1;
    std::printf("V1 level %d error %.5f\n", l, e[l - 1]);
  }
}

TEST(Sphere, ContractsUnderSurfaceTension) {
  Model m;
  m.density = 1;
  m.surface_tension = 0.001;
  const double h = 0.01, T = 0.5 * std::sqrt(m.density * h / m.surface_tension);
  for (const Mass mass : {Mass::lumped, Mass::consistent})
    for (int l = 1; l <= 3; ++l) {
      m.mass = mass;
      const double r = run(m, Scheme::sdirk2, sphere(l, h), T, 100);
      std::printf("V3 %s level %d r %.6f exact %.6f\n", mass == Mass::lumped ? "lumped" : "consistent", l, r,
                  std::cos(1.0));
    }
  m.mass = Mass::lumped;
  for (const auto& [scheme, least] : {std::pair{Scheme::sdirk2, 1.9}, std::pair{Scheme::backward_euler, 0.9}}) {
    double r[3];
    for (int k = 0; k < 3; ++k)
      r[k] = run(m, scheme, sphere(2, h), T, 20 << k);
    std::printf("V3 time order %.3f\n", order(r[0], r[1], r[2]));
    EXPECT_GE(order(r[0], r[1], r[2]), least);
  }
}

} // namespace
} // namespace sheet
