// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/integrated_curve.h"

#include <math.h> // ::isnan, which pchip.hpp of Boost 1.74 needs before it

#include <algorithm>
#include <cmath>

#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/quadrature/gauss.hpp>

namespace sheet {

namespace {

constexpr double longest = 0.25;   // interval of ln γ̇
constexpr double least_part = -35; // ln of the part by which the viscosity differs from that at an end

LogCurve carreau_yasuda(const Liquid& liquid) {
  const FlowLaw law = liquid.law;
  const double zero = liquid.viscosity, infinite = law.infinite_viscosity, a = law.transition;
  const double middle = -std::log(law.time_constant), reach = -least_part / std::min(a, 1.0);
  const auto at = [=](double s) -> LogViscosity {
    const double x = std::exp(a * (s - middle));
    const double above = (zero - infinite) * std::pow(1 + x, (law.flow_index - 1) / a), all = infinite + above;
    return {std::log(all), above / all * (law.flow_index - 1) * x / (1 + x)};
  };
  return {at, middle - reach, middle + reach};
}

LogCurve cross(const Liquid& liquid) {
  const FlowLaw law = liquid.law;
  const double zero = liquid.viscosity, infinite = law.infinite_viscosity, m = 1 - law.flow_index;
  const double middle = -std::log(law.time_constant), reach = -least_part / m;
  const auto at = [=](double s) -> LogViscosity {
    const double x = std::exp(m * (s - middle));
    const double above = (zero - infinite) / (1 + x), all = infinite + above;
    return {std::log(all), -above / all * m * x / (1 + x)};
  };
  return {at, middle - reach, middle + reach};
}

LogCurve tabulated(const FlowLaw& law) {
  using Spline = boost::math::interpolators::pchip<std::vector<double>>;
  const auto logarithms = [](std::vector<double> numbers) {
    for (double& number : numbers)
      number = std::log(number);
    return numbers;
  };
  const double first = std::log(law.rates.front()), last = std::log(law.rates.back());
  const auto spline = std::make_shared<const Spline>(logarithms(law.rates), logarithms(law.viscosities));
  const auto at = [=](double s) -> LogViscosity {
    const double within = std::clamp(s, first, last);
    return {(*spline)(within), spline->prime(within)};
  };
  return {at, first, last};
}

} // namespace

LogCurve log_curve(const Liquid& liquid) {
  return liquid.law.kind == FlowLawKind::table   ? tabulated(liquid.law)
         : liquid.law.kind == FlowLawKind::cross ? cross(liquid)
                                                 : carreau_yasuda(liquid);
}

IntegratedCurve::IntegratedCurve(LogCurve curve) : curve_(std::move(curve)) {
  const auto count = static_cast<std::size_t>(std::ceil((curve_.last - curve_.first) / longest));
  interval_ = (curve_.last - curve_.first) / static_cast<double>(count);
  sums_.resize(count + 1);
  sums_[0] = 0.5 * std::exp(curve_.at(curve_.first).value + 2 * curve_.first);
  for (std::size_t i = 0; i < count; ++i) {
    const double from = curve_.first + interval_ * static_cast<double>(i);
    sums_[i + 1] = sums_[i] + integral(from, from + interval_);
  }
}

double IntegratedCurve::integral(double from, double to) const {
  return boost::math::quadrature::gauss<double, 7>::integrate(
      [&](double s) { return std::exp(curve_.at(s).value + 2 * s); }, from, to);
}

FlowPoint IntegratedCurve::at(double squared_rate) const {
  const double s = 0.5 * std::log(squared_rate); // -inf at rest
  if (s <= curve_.first) {
    const double viscosity = std::exp(curve_.at(curve_.first).value);
    return {0.5 * viscosity * squared_rate, viscosity, 0};
  }
  if (s >= curve_.last) {
    const double viscosity = std::exp(curve_.at(curve_.last).value);
    return {sums_.back() + 0.5 * viscosity * (squared_rate - std::exp(2 * curve_.last)), viscosity, 0};
  }
  const auto i = std::min(static_cast<std::size_t>((s - curve_.first) / interval_), sums_.size() - 2);
  const LogViscosity here = curve_.at(s);
  const double viscosity = std::exp(here.value);
  return {sums_[i] + integral(curve_.first + interval_ * static_cast<double>(i), s), viscosity,
          viscosity * here.slope / squared_rate};
}

} // namespace sheet
