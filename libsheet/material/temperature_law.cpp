// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/temperature_law.h"

#include <math.h> // ::isnan, which pchip.hpp of Boost 1.74 needs before it

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/interpolators/pchip.hpp>

namespace sheet {

namespace {

using Spline = boost::math::interpolators::pchip<std::vector<double>>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int halvings = 100;

Spline log_viscosity(const TemperatureLaw& law) {
  std::vector<double> temperatures = law.temperatures, logarithms = law.viscosities;
  for (double& viscosity : logarithms)
    viscosity = std::log(viscosity);
  return {std::move(temperatures), std::move(logarithms)};
}

double within(const TemperatureLaw& law, double temperature) {
  return std::clamp(temperature, law.temperatures.front(), law.temperatures.back());
}

} // namespace

TemperatureRange range_of(const TemperatureLaw& law) {
  switch (law.kind) {
  case TemperatureLawKind::vft:
    return {law.vft_temperature, infinity};
  case TemperatureLawKind::wlf:
    return {law.reference_temperature - law.wlf_c2, infinity};
  case TemperatureLawKind::table:
    return {law.temperatures.front(), law.temperatures.back()};
  case TemperatureLawKind::constant:
  case TemperatureLawKind::arrhenius:
  case TemperatureLawKind::exponential:
    break;
  }
  return {0, infinity};
}

bool has_viscosity(const TemperatureLaw& law) {
  return law.kind == TemperatureLawKind::table || (law.kind == TemperatureLawKind::vft && law.vft_a);
}

std::optional<double> reference_viscosity(const TemperatureLaw& law) {
  if (!has_viscosity(law) || (law.kind == TemperatureLawKind::table && law.temperatures.empty()))
    return {};
  if (law.kind == TemperatureLawKind::table)
    return std::exp(log_viscosity(law)(within(law, law.reference_temperature)));
  return std::pow(10, *law.vft_a + law.vft_b / (law.reference_temperature - law.vft_temperature));
}

ViscosityShift::ViscosityShift(const TemperatureLaw& law) : law_(law), log_greatest_(std::log(law.greatest_factor)) {
  if (law.kind != TemperatureLawKind::table)
    return;
  const auto spline = std::make_shared<const Spline>(log_viscosity(law));
  const double first = law.temperatures.front(), last = law.temperatures.back();
  const double at_reference = (*spline)(within(law, law.reference_temperature));
  tabulated_ = [=](double temperature) -> Logarithm {
    const bool inside = temperature > first && temperature < last;
    const double t = std::clamp(temperature, first, last);
    return {(*spline)(t)-at_reference, inside ? spline->prime(t) : 0};
  };
}

ViscosityShift::Logarithm ViscosityShift::logarithm(double temperature) const {
  const double reference = law_.reference_temperature;
  switch (law_.kind) {
  case TemperatureLawKind::constant:
    break;
  case TemperatureLawKind::arrhenius: {
    const double activation = law_.activation_energy / gas_constant; // [K]
    return {activation * (1 / temperature - 1 / reference), -activation / (temperature * temperature)};
  }
  case TemperatureLawKind::exponential:
    return {-law_.temperature_coefficient * (temperature - reference), -law_.temperature_coefficient};
  case TemperatureLawKind::vft: {
    const double b = std::numbers::ln10 * law_.vft_b, above = temperature - law_.vft_temperature;
    if (above <= 0)
      return {infinity, 0};
    return {b * (1 / above - 1 / (reference - law_.vft_temperature)), -b / (above * above)};
  }
  case TemperatureLawKind::wlf: {
    const double c1 = std::numbers::ln10 * law_.wlf_c1, above = law_.wlf_c2 + temperature - reference;
    if (above <= 0)
      return {infinity, 0};
    return {-c1 * (temperature - reference) / above, -c1 * law_.wlf_c2 / (above * above)};
  }
  case TemperatureLawKind::table:
    return tabulated_(temperature);
  }
  return {0, 0};
}

ViscosityShift::Point ViscosityShift::at(double temperature) const {
  const Logarithm here = logarithm(temperature);
  if (here.value >= log_greatest_)
    return {law_.greatest_factor, 0};
  if (here.value <= -log_greatest_)
    return {1 / law_.greatest_factor, 0};
  return {std::exp(here.value), here.slope};
}

double ViscosityShift::temperature_of(double factor, double lowest, double highest) const {
  const double wanted = std::log(factor);
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (lowest + highest);
    (logarithm(middle).value > wanted ? lowest : highest) = middle;
  }
  return 0.5 * (lowest + highest);
}

} // namespace sheet
