// SPDX-License-Identifier: GPL-3.0-or-later
// V30: liquids that are not Newtonian, strained alike everywhere.
#include "tests/validation/liquids.h"

namespace sheet::validation {

namespace {

constexpr double first_rate = 2; // [1/s]

// As V7: N = 2 τ h, h r = h0 r0.
Result tube(const Settings& s, const TestedLiquid& liquid, double end) {
  constexpr double h = 0.05;
  const Growth growth{tested_stress, 2, 2};
  return blown_tube(s, liquid.liquid, h, 2 * tested_stress * h, first_rate / growth.rate,
                    time_of_growth(liquid, growth, end), end);
}

// As V1: N = √3 τ h, h r² = h0 r0².
Result balloon(const Settings& s, const TestedLiquid& liquid, double end) {
  constexpr double h = 0.1;
  const Growth growth{tested_stress, 3, 2 * std::numbers::sqrt3};
  State start = film(make_sphere(1, mesh_options(s, 1)), h);
  Model m = viscous(1, s);
  m.liquid = liquid.liquid;
  m.bending = Bending::none;
  m.pressures = {PressureLaw{PressureLaw::Kind::constant, 2 * std::numbers::sqrt3 * tested_stress * h, 1, 1}};
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    start.velocities[v] = first_rate / growth.rate * start.positions[v];
  Run run(std::move(start), m, s, 1);
  run.advance(time_of_growth(liquid, growth, end), s.steps);
  return run.result(mean_radius(run.state()) / end);
}

} // namespace

TestedLiquid tested_liquid(int number, double stress, double rate) {
  if (number == 3) {
    const double yield = 0.5 * stress, viscosity = (stress - yield) / rate;
    return {{.viscosity = viscosity, .law = {.kind = FlowLawKind::bingham, .yield_stress = yield}},
            [=](double at) { return std::max(0.0, at - yield) / viscosity; }};
  }
  constexpr double indices[3] = {1.0 / 3, 0.5, 1.5};
  const double n = indices[number];
  return {{.viscosity = stress / rate, .law = {.kind = FlowLawKind::power, .flow_index = n, .reference_rate = rate}},
          [=](double at) { return rate * std::pow(at / stress, 1 / n); }};
}

double time_of_growth(const TestedLiquid& liquid, const Growth& growth, double end) {
  using Y = Eigen::Matrix<double, 1, 1>;
  return runge_kutta(Y(0.0), 1, end - 1, 4000, [&](double y, const Y&) {
    return Y(growth.rate / (y * liquid.rate(growth.stress * std::pow(y, growth.power))));
  })[0];
}

// Sets 1 to 4: a strip pulled, its sides free, of each liquid; 5 to 8 its width held; 9 to 12 a tube, 13 to 16 a
// balloon under pressure.
Result v30(const Settings& s) {
  const TestedLiquid liquid = tested_liquid((s.set - 1) % tested_liquids, tested_stress, first_rate);
  switch ((s.set - 1) / tested_liquids) {
  case 0:
    return pulled_strip(s, false, liquid, 1.5);
  case 1:
    return pulled_strip(s, true, liquid, 1.5);
  case 2:
    return tube(s, liquid, 1.3);
  default:
    return balloon(s, liquid, 1.2);
  }
}

} // namespace sheet::validation
