// SPDX-License-Identifier: GPL-3.0-or-later
// V27: spheres that enclose a given amount of gas, p = p_a ((m/V)^n - 1). With the film's volume conserved, h r² = h0
// r0², viscous, inertial and capillary forces are those of V3 and V4.
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double h0 = 0.01, density = 1, tension = 0.01, ambient = 0.05;

double ball(double r) { return 4 * pi / 3 * r * r * r; }

Model bubble(double exponent, double pressure) {
  Model m;
  m.liquid.density = density;
  m.liquid.surface_tension = tension;
  m.pressures = {PressureLaw{.kind = PressureLaw::Kind::gas}};
  m.pressures[0].gas = {.ambient = ambient, .exponent = exponent};
  m.pressures[0].gas.amount = amount_of_gas(m.pressures[0].gas, pressure, ball(1));
  return m;
}

Run at_radius_one(const Settings& s, const Model& m) { return {film(make_sphere(1, mesh_options(s, 1)), h0), m, s, 1}; }

// Blown up with too much gas, it creeps to where p = 4 γ/r.
Result comes_to_rest(const Settings& s) {
  constexpr double mu = 0.01, pressure = 0.12;
  Model m = bubble(1, pressure);
  m.liquid.viscosity = mu;
  m.inertia = false;
  m.bending = Bending::none;
  Run run = at_radius_one(s, m);
  run.advance(80 * mu * h0 / tension, s.steps);
  double low = 1, high = 2;
  for (int k = 0; k < 60; ++k) {
    const double r = 0.5 * (low + high);
    (gas_in(m.pressures[0].gas, ball(r), m.pressures[0].gas.amount, 0).pressure > 4 * tension / r ? low : high) = r;
  }
  Result result = run.result(mean_radius(run.state()) / low);
  result.more = {{"radius", low}};
  return result;
}

// Small oscillations about rest: M ω² = 12π n (p_a + p) r - 16π γ, M the film's mass. Two periods, between zeros of the
// speed.
Result oscillates(const Settings& s) {
  constexpr double exponent = 1.4, pressure = 4 * tension, amplitude = 1e-3;
  const Model m = bubble(exponent, pressure);
  const double omega =
      std::sqrt((12 * pi * exponent * (ambient + pressure) - 16 * pi * tension) / (4 * pi * density * h0));
  State start = film(make_sphere(1, mesh_options(s, 1)), h0);
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = amplitude * omega * start.positions[v];
  Run run(std::move(start), m, s, 1);
  std::vector<double> zeros;
  double last_time = 0, last = amplitude * omega;
  run.advance(3 * 2 * pi / omega, s.steps, [&](const State& at) {
    const double speed = radial_speed(at);
    if (last * speed < 0)
      zeros.push_back(last_time + (at.time - last_time) * last / (last - speed));
    last = speed;
    last_time = at.time;
  });
  return run.result(4 * pi / omega / (zeros.at(4) - zeros.at(0)));
}

// The gas leaves by a leak, without inertia: 12 μ h ṙ/r² = p - 4 γ/r, ṁ = -c p.
Result leaks(const Settings& s) {
  constexpr double mu = 0.1, leak = 20, until = 0.3;
  Model m = bubble(1.4, 0.03);
  m.liquid.viscosity = mu;
  m.inertia = false;
  m.bending = Bending::none;
  m.pressures[0].gas.leak = leak;
  const auto pressure = [&](const Eigen::Vector2d& y) {
    return gas_in(m.pressures[0].gas, ball(y[0]), y[1], 0).pressure;
  };
  const auto exact = runge_kutta(Eigen::Vector2d(1, m.pressures[0].gas.amount), 0, until, 100000,
                                 [&](double, const Eigen::Vector2d& y) {
                                   const double r = y[0], p = pressure(y), h = h0 / (r * r);
                                   return Eigen::Vector2d((p - 4 * tension / r) * r * r / (12 * mu * h), -leak * p);
                                 });
  Run run = at_radius_one(s, m);
  run.advance(until, s.steps);
  Result result = run.result(mean_radius(run.state()) / exact[0]);
  result.more = {{"radius", exact[0]}, {"amount_error", run.state().gas.at(0).amount / exact[1] - 1}};
  return result;
}

} // namespace

Result v27(const Settings& s) { return s.set == 1 ? comes_to_rest(s) : s.set == 2 ? oscillates(s) : leaks(s); }

} // namespace sheet::validation
