// SPDX-License-Identifier: GPL-3.0-or-later
// V39: sheets whose temperature, and with it their viscosity, changes while they flow. Where both are the same
// everywhere, the closed forms of sizes become ordinary differential equations of size and temperature.
#include "libsheet/material/driven_rate.h"
#include "libsheet/material/temperature_law.h"
#include "tests/support/holds.h"
#include "tests/validation/setup.h"

namespace sheet::validation {

namespace {

constexpr double start_temperature = 1000, ambient = 400; // [K]
constexpr double balloon_viscosity = 0.1, balloon_thickness = 0.1;

Liquid thermal_liquid(double coefficient, const FlowLaw& law = {}) {
  Liquid liquid{.viscosity = balloon_viscosity, .law = law};
  liquid.temperature_law = {.kind = TemperatureLawKind::exponential,
                            .reference_temperature = start_temperature,
                            .temperature_coefficient = coefficient};
  return liquid;
}

// A balloon of the radius 1 at first under the pressure p: with V30's γ̇ = 2√3 ṙ/r, τ = p r³/(2√3 h0), and of each
// square metre of film, which has two faces,
//   ρ c h T' = -q_u(T) - q_l(T) + h τ γ̇, if it heats itself.
Result cooled_balloon(const Settings& s, const Liquid& liquid, const heat::Surroundings& upper,
                      const heat::Surroundings& lower, bool viscous_heating, double capacity, double pressure,
                      double until) {
  constexpr double h0 = balloon_thickness, c = 2 * std::numbers::sqrt3;
  const ViscosityShift shift(liquid.temperature_law);
  using Y = Eigen::Vector2d;
  const auto derivative = [&](double, const Y& y) {
    const double r = y[0], stress = pressure * r * r * r / (c * h0);
    const double rate = driven_rate(liquid, stress) / shift.factor(y[1]), h = h0 / (r * r);
    const double heating = viscous_heating ? stress * rate : 0;
    return Y(r * rate / c, (heating - (upper.flux(y[1]) + lower.flux(y[1])) / h) / capacity);
  };
  const Y first(1, start_temperature), exact = runge_kutta(first, 0, until, 4000, derivative);
  State start = film(make_sphere(1, mesh_options(s, 1)), h0);
  const Y rates = derivative(0, first);
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = rates[0] * start.positions[v];
  start.temperatures.assign(start.volumes.size(), start_temperature);
  start.temperature_rates.assign(start.volumes.size(), rates[1]);
  Model m = viscous(balloon_viscosity, s);
  m.liquid = liquid;
  m.bending = Bending::none; // of relative size (h/r)²/12, and not in the closed form
  m.pressures = {PressureLaw{PressureLaw::Kind::constant, pressure, 1, 1}};
  m.heat = HeatModel{.capacity = capacity, .surroundings = {upper, lower}, .viscous = viscous_heating};
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  Result result = run.result(mean_radius(run.state()) / exact[0]);
  double warmth = 0, volume = 0;
  for (std::size_t t = 0; t < run.state().volumes.size(); ++t) {
    warmth += run.state().volumes[t] * run.state().temperatures[t];
    volume += run.state().volumes[t];
  }
  const HeatMoved& moved = run.state().heat_moved;
  const double balance =
      capacity * (warmth - start_temperature * volume) - (moved.generated - moved.upper - moved.lower - moved.solids);
  result.more = {{"radius", exact[0]},
                 {"temperature", exact[1]},
                 {"temperature_error", warmth / volume / exact[1] - 1},
                 {"balance", balance / (capacity * start_temperature * volume)}};
  return result;
}

bool ends(double a, double b) { return std::abs(a - b) < 1e-9; }

// V13 as it cools through its lower face, lumped: T - T_a = (T0 - T_a) e^(-t/t_c), t_c = ρ c h/H, so with
// μ = μ0 e^(-b (T - T0)) the sag is s³ = s0³ + (9 ρ g L⁴/512) ∫ dt/μ.
Result cooled_catenary(const Settings& s) {
  constexpr double h = 2.5e-5, density = 1000, gravity = 9.81, mu = 100, first = 0.0025, width = 0.25;
  constexpr double coefficient = 0.004, part = 9 * density * gravity / (512 * mu), heavy = density * 2000;
  const double until = (std::pow(0.005, 3) - std::pow(first, 3)) / part, cooling = 0.7 * until;
  Liquid liquid = thermal_liquid(coefficient);
  liquid.viscosity = mu;
  liquid.density = density;
  using Y = Eigen::Vector2d;
  const auto derivative = [&](double, const Y& y) {
    return Y(part * std::exp(coefficient * (y[1] - start_temperature)), -(y[1] - ambient) / cooling);
  };
  const Y begin(std::pow(first, 3), start_temperature), exact = runge_kutta(begin, 0, until, 4000, derivative);
  State start = film(strip_mesh(s, 1, width), h);
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    Vector3& x = start.positions[v];
    const double shape = -4 * x.x() * (1 - x.x());
    x.z() = first * shape;
    start.velocities[v].z() = part / (3 * first * first) * shape;
  }
  start.temperatures.assign(start.volumes.size(), start_temperature);
  start.temperature_rates.assign(start.volumes.size(), derivative(0, begin)[1]);
  Model m = viscous(mu, s);
  m.liquid = liquid;
  m.gravity = {0, 0, -gravity};
  Hold side = hold(
      start, [](const Vector3& x) { return ends(x.y(), 0) || ends(x.y(), width); }, axis_bit(1), false);
  for (std::uint32_t e = 0; e < start.mesh->edges.size(); ++e) {
    const double a = start.positions[start.mesh->edges[e][0]].y(), b = start.positions[start.mesh->edges[e][1]].y();
    if (start.mesh->on_rim(e) && ends(a, b) && (ends(a, 0) || ends(a, width)))
      side.clamped_edges.push_back(e);
  }
  m.holds.push_back(std::move(side));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return ends(x.x(), 0) || ends(x.x(), 1); }, all_axes, false));
  m.heat = HeatModel{.capacity = heavy, .surroundings = {heat::Surroundings{}, {heavy * h / cooling, ambient}}};
  Run run(std::move(start), m, s, 1);
  run.advance(until, s.steps);
  double up = 0, down = 0; // the parabola of least squares
  for (const Vector3& x : run.state().positions) {
    const double shape = 4 * x.x() * (1 - x.x());
    up -= shape * x.z(), down += shape * shape;
  }
  return run.result(up / down / std::cbrt(exact[0]));
}

// Surface tension γ0 (1 + a (x/L - 1/2)) along a strip held at both ends and, across, at its sides, of constant
// viscosity: the tension 2γ + 4 μ h u' is the same everywhere, so u = γ0 a x (1 - x/L)/(4 μ h), in the middle
// γ0 a L/(16 μ h), towards where it is greater.
Result marangoni(const Settings& s) {
  constexpr double h = 0.01, mu = 100, tension = 0.5, a = 0.4, width = 0.25;
  State start = film(strip_mesh(s, 1, width), h);
  for (const Corners& c : start.mesh->triangles) {
    const double x = (start.positions[c[0]] + start.positions[c[1]] + start.positions[c[2]]).x() / 3;
    start.temperatures.push_back(start_temperature + 100 * (x - 0.5));
  }
  Model m = viscous(mu, s);
  m.liquid = {.viscosity = mu, .surface_tension = tension, .surface_tension_slope = tension * a / 100};
  m.liquid.temperature_law.reference_temperature = start_temperature;
  m.bending = Bending::none;
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return ends(x.x(), 0) || ends(x.x(), 1); }, all_axes, false));
  m.holds.push_back(hold(
      start, [](const Vector3& x) { return ends(x.y(), 0) || ends(x.y(), width); }, axis_bit(1), false));
  m.holds.push_back(hold(
      start, [](const Vector3&) { return true; }, axis_bit(2), false));
  Run run(std::move(start), m, s, 1);
  run.advance(1e-3 * mu * h / tension, 1);
  double speed = 0, weight = 0;
  for (std::size_t v = 0; v < run.state().positions.size(); ++v) {
    const double shape = 4 * run.state().positions[v].x() * (1 - run.state().positions[v].x());
    speed += shape * run.state().velocities[v].x(), weight += shape * shape;
  }
  return run.result(speed / weight / (tension * a / (16 * mu * h)));
}

} // namespace

Result v39(const Settings& s) {
  const heat::Surroundings none, air{.transfer = 20, .ambient = ambient};
  const heat::Surroundings dark{.emissivity = 0.9, .radiant = ambient};
  constexpr double until = 0.4, capacity = 250; // [s], [J/(m³ K)]
  const FlowLaw thinning{.kind = FlowLawKind::power, .flow_index = 0.5, .rest_rate = 1e-6};
  switch (s.set) {
  case 1:
    return cooled_balloon(s, thermal_liquid(0.004), air, air, false, capacity, 0.15, until);
  case 2:
    return cooled_balloon(s, thermal_liquid(0.004), dark, none, false, capacity, 0.15, until);
  case 3:
    return cooled_balloon(s, thermal_liquid(0.004, thinning), air, none, false, capacity, 0.045, until);
  case 4:
    return cooled_balloon(s, thermal_liquid(1), none, none, true, 1, 0.1, 0.5 * until);
  case 5:
    return cooled_catenary(s);
  default:
    return marangoni(s);
  }
}

} // namespace sheet::validation
