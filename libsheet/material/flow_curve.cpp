// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/flow_curve.h"

#include <cmath>

#include "libsheet/material/integrated_curve.h"
#include "libsheet/material/kept.h"

namespace sheet {

namespace {

constexpr double of_own_rate = 1e-5; // of the rest rate
constexpr double small = 0.1;        // part of the shift below which powers would nearly cancel

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
  const double rest = rest_rate * rest_rate, power = (law.flow_index - 1) / 2;
  const double viscosity = liquid.viscosity, infinite = law.infinite_viscosity;
  switch (law.kind) {
  case FlowLawKind::cross:
  case FlowLawKind::table:
    break; // not elementary
  case FlowLawKind::newtonian:
    newtonian_ = viscosity;
    break;
  case FlowLawKind::power:
    add(consistency(liquid), rest, 1, power);
    break;
  case FlowLawKind::carreau:
    newtonian_ = infinite;
    add(viscosity - infinite, 1, law.time_constant * law.time_constant, power);
    break;
  case FlowLawKind::bingham:
    newtonian_ = viscosity;
    add(law.yield_stress, rest, 1, -0.5);
    break;
  case FlowLawKind::herschel_bulkley:
    add(law.yield_stress, rest, 1, -0.5);
    add(consistency(liquid), rest, 1, power);
    break;
  case FlowLawKind::casson:
    newtonian_ = viscosity;
    add(law.yield_stress, rest, 1, -0.5);
    add(2 * std::sqrt(law.yield_stress * viscosity), rest, 1, -0.25);
    break;
  }
}

void FlowCurve::add(double factor, double shift, double slope, double exponent) {
  term_[terms_++] = {factor, shift, slope, exponent, std::pow(shift, exponent + 1)};
}

FlowPoint FlowCurve::at(double squared_rate) const {
  if (integrated_)
    return integrated_->at(squared_rate);
  FlowPoint point{0.5 * newtonian_ * squared_rate, newtonian_, 0};
  for (int i = 0; i < terms_; ++i) {
    const auto [factor, shift, slope, exponent, at_rest] = term_[i];
    const double y = shift + slope * squared_rate;
    const double power = factor * (exponent == -0.5 ? 1 / std::sqrt(y) : std::pow(y, exponent));
    const double part = slope * squared_rate / shift;
    const double risen =
        part < small ? factor * at_rest * std::expm1((exponent + 1) * std::log1p(part)) : power * y - factor * at_rest;
    point.potential += risen / (2 * slope * (exponent + 1));
    point.viscosity += power;
    point.slope += 2 * exponent * slope * power / y;
  }
  return point;
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
  for (int i = 0; i < count; ++i) {
    const FlowPoint point = curve.at(squared_rates[i]);
    potentials[i] = point.potential;
    if (viscosities != nullptr)
      viscosities[i] = point.viscosity;
    if (slopes != nullptr)
      slopes[i] = point.slope;
  }
}

} // namespace sheet
