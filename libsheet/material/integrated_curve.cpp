// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/integrated_curve.h"

#include <math.h> // ::isnan, which pchip.hpp of Boost 1.74 needs before it

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/quadrature/gauss.hpp>

namespace sheet {

namespace {

constexpr double longest = 0.05;   // interval of ln γ̇
constexpr double least_part = -35; // ln of the part by which the viscosity differs from that at an end
constexpr double widest = 230;     // ln γ̇ of the ends: rates of 1e-100 to 1e100, whose squares are numbers

LogCurve between_plateaus(std::function<LogViscosity(double)> at, double middle, double reach) {
  return {std::move(at), std::max(middle - reach, -widest), std::min(middle + reach, widest)};
}

LogCurve carreau_yasuda(const Liquid& liquid) {
  const FlowLaw law = liquid.law;
  const double zero = liquid.viscosity, infinite = law.infinite_viscosity, a = law.transition;
  const double middle = -std::log(law.time_constant), reach = -least_part / std::min(a, 1.0);
  const auto at = [=](double s) -> LogViscosity {
    const double x = std::exp(a * (s - middle));
    const double above = (zero - infinite) * std::pow(1 + x, (law.flow_index - 1) / a), all = infinite + above;
    return {std::log(all), above / all * (law.flow_index - 1) * x / (1 + x)};
  };
  return between_plateaus(at, middle, reach);
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
  return between_plateaus(at, middle, reach);
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

IntegratedCurve::IntegratedCurve(const LogCurve& curve)
    : first_(curve.first), last_(curve.last), first_viscosity_(std::exp(curve.at(curve.first).value)),
      last_viscosity_(std::exp(curve.at(curve.last).value)) {
  const auto growth = [&](double s) { return std::exp(curve.at(s).value + 2 * s); };
  double before = first_, sum = 0.5 * growth(first_);
  potential_ = LogSpline(first_, last_, longest, [&](double rate) {
    const double s = std::log(rate);
    sum += boost::math::quadrature::gauss<double, 7>::integrate(growth, before, s);
    before = s;
    const LogViscosity here = curve.at(s);
    const double viscosity = std::exp(here.value);
    return LogSpline::Point{sum, viscosity * rate, viscosity * (1 + here.slope)};
  });
  last_potential_ = sum;
}

FlowPoint IntegratedCurve::at(double squared_rate) const {
  const double s = 0.5 * std::log(squared_rate); // -inf at rest
  if (s <= first_)
    return {0.5 * first_viscosity_ * squared_rate, first_viscosity_, 0};
  if (s >= last_)
    return {last_potential_ + 0.5 * last_viscosity_ * (squared_rate - std::exp(2 * last_)), last_viscosity_, 0};
  const double rate = std::sqrt(squared_rate);
  const LogSpline::Point point = potential_.at(rate, s);
  const double viscosity = point.first / rate;
  return {point.value, viscosity, (point.second - viscosity) / squared_rate};
}

} // namespace sheet
