// SPDX-License-Identifier: GPL-3.0-or-later
// V1 to V4: spheres that stay spheres. Films of thickness h on a sphere of radius r, volume conserved: h r² = h0 r0².
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

// Fig. 6 of [Batty et al. 2012]: h 0.1 or 0.3, μ 0.1; the pressures, which the paper does not give, are ours.
struct Balloon {
  double thickness, pressure;
};
constexpr double viscosity = 0.1;
constexpr double part_of_blow_up = 0.8; // of the blow-up time

Result balloon(const Settings& s, const Balloon& b, PressureLaw::Kind kind, double until, double exact) {
  State start = film(make_sphere(1, mesh_options(s, 1)), b.thickness);
  Model m = viscous(viscosity, s);
  m.bending = Bending::none; // of relative size (h/r)²/12, and not in the closed form
  m.pressures = {PressureLaw{kind, b.pressure, 1, 1}};
  // The flow at the start, so that the first step's prediction is as good as the others'.
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = b.pressure / (12 * viscosity * b.thickness) * start.positions[v];
  Run run(std::move(start), m, s, 1);
  std::vector<std::vector<double>> series;
  run.advance(until, s.steps, [&](const State& at) {
    const double r = mean_radius(at), speed = radial_speed(at), h = b.thickness / (r * r);
    const double p = kind == PressureLaw::Kind::constant ? b.pressure : b.pressure / (r * r);
    series.push_back({at.time, r, speed, p * r * r / viscosity, h * speed});
  });
  Result result = run.result(mean_radius(run.state()) / exact);
  result.series = std::move(series);
  return result;
}

} // namespace

// ṙ = p r²/(12 μ h): r = (1 - p t/(4 μ h0))^(-1/3) at constant pressure.
Result v1(const Settings& s) {
  const Balloon b = s.set == 1 ? Balloon{0.1, 0.1} : Balloon{0.3, 0.15};
  const double until = part_of_blow_up * 4 * viscosity * b.thickness / b.pressure;
  return balloon(s, b, PressureLaw::Kind::constant, until, std::pow(1 - part_of_blow_up, -1.0 / 3));
}

// p = p0/r²: r = 1/(1 - p0 t/(12 μ h0)).
Result v2(const Settings& s) {
  constexpr double part = 0.5; // of the blow-up time: the radius doubles
  const Balloon b = s.set == 1 ? Balloon{0.1, 0.2} : Balloon{0.3, 0.3};
  const double until = part * 12 * viscosity * b.thickness / b.pressure;
  return balloon(s, b, PressureLaw::Kind::inverse_square, until, 1 / (1 - part));
}

// Inviscid sphere: mass m = 4π ρ h0, kinetic energy 2π ρ h0 ṙ², potential 8π γ r² (two sides): r = cos(t/T),
// T = sqrt(ρ h0/γ)/2. Fig. 7 of [Batty et al. 2012], up to 1.2 T.
Result v3(const Settings& s) {
  constexpr double table[4][3] = {{0.01, 1, 0.001}, {0.02, 1.3, 0.003}, {0.05, 0.2, 0.01}, {0.06, 0.25, 0.004}};
  const double* p = table[s.set - 1];
  const double unit = 0.5 * std::sqrt(p[1] * p[0] / p[2]), until = 1.2;
  Model m;
  m.liquid.density = p[1];
  m.liquid.surface_tension = p[2];
  Run run(film(make_sphere(1, mesh_options(s, 1)), p[0]), m, s, 1);
  std::vector<std::vector<double>> series;
  run.advance(until * unit, s.steps, [&](const State& at) {
    series.push_back({at.time, mean_radius(at), radial_speed(at), at.time / unit, mean_radius(at)});
  });
  Result r = run.result(mean_radius(run.state()) / std::cos(until));
  r.series = std::move(series);
  return r;
}

// ρ h r̈ = -12 μ h ṙ/r² - 4 γ/r + p with h = h0/r²: a balloon that is blown up against inertia and surface tension.
Result v4(const Settings& s) {
  constexpr double h0 = 0.1, density = 2, tension = 0.05, pressure = 0.5, mu = 0.1, until = 0.5;
  Model m = viscous(mu, s);
  m.bending = Bending::none;
  m.inertia = true;
  m.liquid.density = density;
  m.liquid.surface_tension = tension;
  m.pressures = {PressureLaw{PressureLaw::Kind::constant, pressure, 1, 1}};
  using Y = Eigen::Vector2d;
  const Y exact = runge_kutta(Y(1, 0), 0, until, 100000, [&](double, const Y& y) {
    const double r = y[0], h = h0 / (r * r);
    return Y(y[1], (pressure - 4 * tension / r - 12 * mu * h * y[1] / (r * r)) / (density * h));
  });
  Run run(film(make_sphere(1, mesh_options(s, 1)), h0), m, s, 1);
  run.advance(until, s.steps);
  Result r = run.result(mean_radius(run.state()) / exact[0]);
  r.more = {{"radius", exact[0]}, {"speed_error", radial_speed(run.state()) / exact[1] - 1}};
  return r;
}

} // namespace sheet::validation
