// SPDX-License-Identifier: GPL-3.0-or-later
// Closed forms of docs/model.md at small sizes: V4 viscous sphere with inertia, V8 contracting disk, V12 strips in
// plane strain, V17 pinned film.
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

double area(const State& s) {
  double sum = 0;
  for (const Corners& t : s.mesh->triangles)
    sum += 0.5 * std::sqrt(form_determinant(squared_lengths(s.positions[t[0]], s.positions[t[1]], s.positions[t[2]])));
  return sum;
}

// V8: R^-2 = R0^-2 + 2π γ t/(3 μ V), exact for any mesh of flat triangles, so for the area too.
TEST(Disk, ContractsUnderSurfaceTension) {
  const State start = test::at_rest(test::disk(1, 6, 0.2), 0.02);
  Model m;
  m.liquid.viscosity = 100;
  m.liquid.surface_tension = 1;
  m.inertia = false;
  double volume = 0;
  for (const double v : start.volumes)
    volume += v;
  const double until = 2 * 100 * 0.02; // gamma t/(mu h) = 2
  const double exact = 1 / (1 / area(start) + 2 * m.liquid.surface_tension * until / (3 * m.liquid.viscosity * volume));
  for (const auto& [scheme, least] : {std::pair{Scheme::sdirk2, 1.9}, std::pair{Scheme::backward_euler, 0.8}}) {
    StepOptions options;
    options.scheme = scheme;
    double e[3];
    for (int k = 0; k < 3; ++k) {
      State s = start;
      Stepper stepper(m, options);
      for (int i = 0; i < 10 << k; ++i)
        stepper.step(s, until / (10 << k));
      e[k] = area(s) / exact - 1;
    }
    std::printf("V8 %s: area errors %.2e %.2e %.2e orders %.2f %.2f\n", scheme == Scheme::sdirk2 ? "sdirk2" : "BE",
                e[0], e[1], e[2], std::log2(std::abs(e[0] / e[1])), std::log2(std::abs(e[1] / e[2])));
    EXPECT_GE(std::log2(std::abs(e[1] / e[2])), least);
  }
}

// V17: period of the fundamental mode of a square film, by its first return through zero.
TEST(Film, OscillatesWithTheRightFrequency) {
  double e[2];
  for (int k = 0; k < 2; ++k) {
    const int n = 10 << k;
    test::Mesh mesh = test::rectangle(1, 1, n, n, 0.2);
    State s = test::at_rest(mesh, 0.001);
    for (Vector3& x : s.positions)
      x.z() = 1e-3 * std::sin(std::numbers::pi * x.x()) * std::sin(std::numbers::pi * x.y());
    Model m;
    m.liquid.density = 1000;
    m.liquid.surface_tension = 1;
    Hold hold;
    std::size_t middle = 0;
    for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
      const Vector3& x = s.positions[v];
      if (x.x() == 0 || x.y() == 0 || x.x() == 1 || x.y() == 1)
        hold.vertices.push_back(v);
      if ((x - Vector3(0.5, 0.5, x.z())).norm() <
          (s.positions[middle] - Vector3(0.5, 0.5, s.positions[middle].z())).norm())
        middle = v;
    }
    m.holds.push_back(hold);
    const double omega =
        std::numbers::pi * std::sqrt(2.0) * std::sqrt(2 * m.liquid.surface_tension / (m.liquid.density * 0.001));
    const double quarter = 0.5 * std::numbers::pi / omega;
    Stepper stepper(m, {});
    double before = s.positions[middle].z(), crossing = 0;
    for (int i = 0; i < 120; ++i) {
      stepper.step(s, quarter / 100);
      const double z = s.positions[middle].z();
      if (before > 0 && z <= 0) {
        crossing = s.time - quarter / 100 * z / (z - before);
        break;
      }
      before = z;
    }
    e[k] = quarter / crossing - 1;
  }
  std::printf("V17: frequency errors %.2e %.2e\n", e[0], e[1]);
  EXPECT_LT(std::abs(e[1]), 0.01);
}

// V12: start velocity of a strip in plane strain, edge L/64 (a 32nd of the half span).
TEST(Strip, SagsInPlaneStrain) {
  constexpr double viscosity = 100, h = 0.01, density = 1000, g = 9.81;
  const double d = viscosity * h * h * h / 3, q = density * g * h;
  struct Case {
    const char* name;
    bool clamp_start, hold_end, clamp_end;
    double at, exact;
  };
  for (const Case& c : {Case{"clamped", true, true, true, 0.5, q / (384 * d)},
                        Case{"supported", false, true, false, 0.5, 5 * q / (384 * d)},
                        Case{"cantilever", true, false, false, 1, q / (8 * d)}}) {
    double e[2];
    for (int k = 0; k < 2; ++k) {
      const int n = 32 << k;
      const test::Mesh mesh = test::rectangle(1, 0.125, n, n / 8, 0.2);
      State s = test::at_rest(mesh, h);
      Model m;
      m.liquid.viscosity = viscosity;
      m.liquid.density = density;
      m.gravity = {0, 0, -g};
      m.inertia = false;
      m.bending = Bending::mid_edge;
      Hold sides, ends;
      sides.axes = axis_bit(1);
      for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
        const Vector3& x = s.positions[v];
        if (x.y() == 0 || x.y() == 0.125)
          sides.vertices.push_back(v);
        if (x.x() == 0 || (x.x() == 1 && c.hold_end))
          ends.vertices.push_back(v);
      }
      for (std::uint32_t i = 0; i < s.mesh->edges.size(); ++i) {
        const Vector3 &a = s.positions[s.mesh->edges[i][0]], &b = s.positions[s.mesh->edges[i][1]];
        if (s.mesh->on_rim(i) && a.y() == b.y())
          sides.clamped_edges.push_back(i);
        if (a.x() == b.x() && ((a.x() == 0 && c.clamp_start) || (a.x() == 1 && c.clamp_end)))
          ends.clamped_edges.push_back(i);
      }
      m.holds = {sides, ends};
      const double dt = 1e-5 / c.exact;
      Stepper stepper(m, {});
      stepper.step(s, dt);
      double sum = 0;
      int count = 0;
      for (std::size_t v = 0; v < mesh.positions.size(); ++v) // the whole line across the strip
        if (std::abs(mesh.positions[v].x() - c.at) < 0.3 / n) {
          sum -= s.positions[v].z() / dt;
          ++count;
        }
      e[k] = sum / count / c.exact - 1;
    }
    std::printf("V12 %s: errors %.4f %.4f order %.2f\n", c.name, e[0], e[1], std::log2(std::abs(e[0] / e[1])));
    EXPECT_LT(std::abs(e[1]), 0.01) << c.name;
  }
}

// V4: rho h rddot = -12 mu h rdot/r² - 4 gamma/r, h = h0 r0²/r², by the classical Runge-Kutta method.
TEST(Sphere, ViscousWithInertia) {
  constexpr double mu = 0.02, rho = 1, h0 = 0.01, gamma = 0.001, until = 1;
  double r = 1, v = 0;
  const auto acceleration = [](double x, double w) {
    return (-12 * mu * w / (x * x) - 4 * gamma / (x * h0 / (x * x))) / rho;
  };
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double dt = until / n;
    const double a1 = acceleration(r, v), v2 = v + 0.5 * dt * a1, a2 = acceleration(r + 0.5 * dt * v, v2);
    const double v3 = v + 0.5 * dt * a2, a3 = acceleration(r + 0.5 * dt * v2, v3), v4 = v + dt * a3;
    const double a4 = acceleration(r + dt * v3, v4);
    r += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  State s = test::at_rest(test::icosphere(3), h0);
  Model m;
  m.liquid.viscosity = mu;
  m.liquid.density = rho;
  m.liquid.surface_tension = gamma;
  Stepper stepper(m, {});
  for (int i = 0; i < 50; ++i)
    stepper.step(s, until / 50);
  double mean = 0;
  for (const Vector3& x : s.positions)
    mean += x.norm() / static_cast<double>(s.positions.size());
  std::printf("V4: r %.6f exact %.6f\n", mean, r);
  EXPECT_NEAR(mean, r, 0.01 * r);
}

} // namespace
} // namespace sheet
