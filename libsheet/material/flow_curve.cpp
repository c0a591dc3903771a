// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/flow_curve.h"

#include <cmath>

#include "libsheet/material/integrated_curve.h"
#include "libsheet/material/kept.h"

namespace sheet {

namespace {

constexpr double of_own_rate = 1e-5; // of the rest rate

// K, of a power law.
double consistency(const Liquid& liquid) {
  return liquid.viscosity * std::pow(liquid.law.reference_rate, 1 - liquid.law.flow_index);
}

} // namespace

double yield_rate(const Liquid& liquid) {
  const FlowLaw& law = liquid.law;
  if (!law.yields())
    return 0;
  return law.kind == FlowLawKind::herschel_bulkley
             ? std::pow(law.yield_stress / consistency(liquid), 1 / law.flow_index)
             : law.yield_stress / liquid.viscosity;
}

double rest_rate(const Liquid& liquid) {
  if (liquid.law.rest_rate)
    return *liquid.law.rest_rate;
  if (liquid.law.yields())
    return of_own_rate * yield_rate(liquid);
  return liquid.law.kind == FlowLawKind::power ? of_own_rate * liquid.law.reference_rate : 0;
}

FlowCurve soft_curve(const Liquid& liquid) {
  return liquid.law.yields() ? FlowCurve(liquid, softest * yield_rate(liquid)) : FlowCurve(liquid);
}

FlowCurve::FlowCurve(const Liquid& liquid) : FlowCurve(liquid, rest_rate(liquid)) {}

FlowCurve::FlowCurve(const Liquid& liquid, double rest_rate) {
  const FlowLaw& law = liquid.law;
  if (!law.elementary()) {
    static Kept<IntegratedCurve> kept;
    integrated_ = kept.of(liquid, [&] { return IntegratedCurve(log_curve(liquid)); });
    return;
  }
  const double power = (law.flow_index - 1) / 2;
  powers_.shift = rest_rate * rest_rate;
  switch (law.kind) {
  case FlowLawKind::cross:
  case FlowLawKind::table:
    break; // not elementary
  case FlowLawKind::newtonian:
    powers_.infinite = liquid.viscosity;
    break;
  case FlowLawKind::power:
    powers_.add(consistency(liquid), power);
    break;
  case FlowLawKind::carreau:
    powers_.infinite = law.infinite_viscosity;
    powers_.shift = 1;
    powers_.slope = law.time_constant * law.time_constant;
    powers_.add(liquid.viscosity - law.infinite_viscosity, power);
    break;
  case FlowLawKind::bingham:
    powers_.infinite = liquid.viscosity;
    powers_.add(law.yield_stress, -0.5);
    break;
  case FlowLawKind::herschel_bulkley:
    powers_.add(law.yield_stress, -0.5);
    powers_.add(consistency(liquid), power);
    break;
  case FlowLawKind::casson:
    powers_.infinite = liquid.viscosity;
    powers_.add(law.yield_stress, -0.5);
    powers_.add(2 * std::sqrt(law.yield_stress * liquid.viscosity), -0.25);
    break;
  }
}

FlowPoint FlowCurve::at(double squared_rate) const {
  if (integrated_)
    return integrated_->at(squared_rate);
  switch (powers_.terms) {
  case 0:
    return {0.5 * powers_.infinite * squared_rate, powers_.infinite, 0};
  case 1:
    return flow_point<1>(powers_, squared_rate);
  default:
    return flow_point<2>(powers_, squared_rate);
  }
}

double viscosity_of(const Liquid& liquid, StrainRate rate) {
  if (liquid.law.newtonian())
    return liquid.viscosity;
  return liquid.law.elementary() ? FlowCurve(liquid).viscosity(rate)
                                 : std::exp(log_curve(liquid).at(0.5 * std::log(rate.squared)).value);
}

double FlowCurve::tangent_viscosity(StrainRate rate) const {
  const FlowPoint point = at(rate.squared);
  return point.viscosity + point.slope * rate.squared;
}

void flow_points(const FlowCurve& curve, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes) {
  if (curve.powers_.terms > 0) {
    flow_points(curve.powers_, count, squared_rates, potentials, viscosities, slopes);
    return;
  }
  for (int i = 0; i < count; ++i) {
    const FlowPoint point = curve.at(squared_rates[i]);
    potentials[i] = point.potential;
    viscosities[i] = point.viscosity;
    slopes[i] = point.slope;
  }
}

} // namespace sheet
