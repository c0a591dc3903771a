// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/wall_flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libsheet/material/kept.h"

namespace sheet {

namespace {

constexpr double interval = 0.01;         // of ln G
constexpr double below = 1e-4;            // the first row, over the rest rate or another rate of the liquid's
constexpr double above = 1e10;            // the last row, over the same or that at which it yields
constexpr double velocity_interval = 0.1; // of ln(u/h)
constexpr double close_enough = 1e-14;    // of ln G
constexpr double beyond = 200;            // of ln G, after the last row
constexpr int most_iterations = 60;

// From where on the viscosity may change [1/s].
double first_rate(const Liquid& liquid) {
  const FlowLaw& law = liquid.law;
  if (const double rest = rest_rate(liquid); rest > 0)
    return rest;
  return law.kind == FlowLawKind::table ? law.rates.front() : 1e-6 / law.time_constant;
}

double own_rate(const Liquid& liquid) { return std::max(liquid.law.reference_rate, yield_rate(liquid)); }

// The cubic through two values with these slopes, at the part x of the interval of the width w.
double hermite(double x, double w, double from, double to, double slope_from, double slope_to) {
  const double y = 1 - x;
  return from * y * y * (1 + 2 * x) + to * x * x * (1 + 2 * y) + w * x * y * (slope_from * y - slope_to * x);
}

} // namespace

WallFlow::WallFlow(const Liquid& liquid) : curve_(liquid) {
  const double first = first_rate(liquid);
  first_ = std::log(below * first);
  const double last = std::log(above * std::max(first, own_rate(liquid)));
  const auto rows = static_cast<std::size_t>((last - first_) / interval);
  double moment = 0, conjugate = 0; // ∫ τ γ̇ dτ, ∫ f dτ
  Place before{};
  for (std::size_t i = 0; i < rows; ++i) {
    const double s = first_ + interval * static_cast<double>(i);
    Place here = place(s);
    if (i == 0) { // Newtonian so far
      moment = here.stress * here.stress * here.rate / 3;
      conjugate = here.stress * here.rate / 6;
    } else {
      Place middle = place(s - interval / 2);
      moment += moment_of_half(s - interval, interval / 2);
      middle.f = moment / (middle.stress * middle.stress);
      moment += moment_of_half(s - interval / 2, interval / 2);
      here.f = moment / (here.stress * here.stress);
      conjugate +=
          interval / 6 * (before.f * before.rise + 4 * middle.f * middle.rise + here.f * here.rise); // [Simpson]
    }
    here.f = moment / (here.stress * here.stress);
    rates_.push_back(here.rate);
    stresses_.push_back(here.stress);
    values_.push_back(here.f);
    f_.push_back(std::log(here.f));
    slope_.push_back(here.rise / here.stress * (here.rate / here.f - 2));
    conjugate_.push_back(std::log(conjugate));
    rise_.push_back(here.f * here.rise / conjugate);
    before = here;
  }
  without_slip_ = LogSpline(f_.front(), f_.back(), velocity_interval, [&](double v) {
    const Drag drag = summed_up(v, 1, 0);
    return LogSpline::Point{drag.potential, drag.stress, drag.slope};
  });
}

std::shared_ptr<const WallFlow> wall_flow_of(const Liquid& liquid) {
  static Kept<WallFlow> kept;
  return kept.of(liquid, [&] { return WallFlow(liquid); });
}

WallFlow::Place WallFlow::place(double log_rate) const {
  const double rate = std::exp(log_rate);
  const FlowPoint point = curve_.at(rate * rate);
  return {rate, point.viscosity * rate, rate * (point.viscosity + point.slope * rate * rate), 0};
}

// ∫ τ γ̇ dτ over a part of ln G, by Gauss' two points.
double WallFlow::moment_of_half(double from, double width) const {
  double sum = 0;
  for (const double side : {-1.0, 1.0}) {
    const Place at = place(from + width / 2 * (1 + side / std::numbers::sqrt3));
    sum += width / 2 * at.stress * at.rate * at.rise;
  }
  return sum;
}

WallFlow::Point WallFlow::at(double log_rate) const {
  const double place = (log_rate - first_) / interval, last = static_cast<double>(f_.size() - 1);
  if (place <= 0) // Newtonian
    return {std::exp(f_.front() + (log_rate - first_)), std::exp(conjugate_.front() + 2 * (log_rate - first_))};
  if (place >= last) { // as a power law goes on
    const double more = log_rate - first_ - interval * last;
    return {std::exp(f_.back() + slope_.back() * more), std::exp(conjugate_.back() + rise_.back() * more)};
  }
  const auto i = static_cast<std::size_t>(place);
  const double x = place - static_cast<double>(i);
  return {std::exp(hermite(x, interval, f_[i], f_[i + 1], slope_[i], slope_[i + 1])),
          std::exp(hermite(x, interval, conjugate_[i], conjugate_[i + 1], rise_[i], rise_[i + 1]))};
}

// ln G at the mean velocity u: the interval by halving, then Newton's method within it on ln u over ln G.
double WallFlow::log_rate(double u, double h, double b) const {
  const auto slower = [&](std::size_t row) { return b * rates_[row] + h * values_[row] <= u; };
  if (!slower(0)) // Newtonian
    return std::log(u / (b + h * std::exp(f_.front() - first_)));
  std::size_t row = 0, end = f_.size();
  while (end - row > 1) {
    const std::size_t middle = row + (end - row) / 2;
    (slower(middle) ? row : end) = middle;
  }
  double low = first_ + interval * static_cast<double>(row);
  double high = end == f_.size() ? low + beyond : low + interval;
  double s = end == f_.size() ? low : 0.5 * (low + high);
  for (int i = 0; i < most_iterations; ++i) {
    const double g = std::exp(s), f = at(s).f, there = b * g + h * f;
    (there < u ? low : high) = s;
    const double tangent = curve_.tangent_viscosity({g * g}) / curve_.stress(g); // τ'/τ
    const double next = s + std::log(u / there) * there / (g * (b + h * tangent * (g - 2 * f)));
    const double kept = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(kept - s) <= close_enough * std::max(1.0, std::abs(s)))
      break;
    s = kept;
  }
  return s;
}

WallFlow::Drag WallFlow::drag(double u, double h, double b) const {
  const double v = u / h, log_v = std::log(v);
  if (b > 0 || !without_slip_.covers(log_v))
    return summed_up(u, h, b);
  const LogSpline::Point point = without_slip_.at(v, log_v);
  return {h * point.value, point.first, point.second / h};
}

// From the sums over ln G.
WallFlow::Drag WallFlow::summed_up(double u, double h, double b) const {
  const double s = log_rate(u, h, b), g = std::exp(s);
  const Point point = at(s);
  const FlowPoint flow = curve_.at(g * g);
  const double stress = flow.viscosity * g, rise = flow.viscosity + flow.slope * g * g; // τ, τ'
  const double conjugate = b * (g * stress - flow.potential) + h * point.conjugate;
  return {stress * u - conjugate, stress, rise / (b + h * rise / stress * (g - 2 * point.f))};
}

// The row by halving, then Newton's method on ln τ over ln G from there.
double WallFlow::velocity(double stress, double h, double b) const {
  const auto row = std::ranges::upper_bound(stresses_, stress) - stresses_.begin();
  double s = first_ + interval * static_cast<double>(std::max<std::ptrdiff_t>(row - 1, 0));
  for (int i = 0; i < most_iterations; ++i) {
    const Place here = place(s);
    const double change = std::log(stress / here.stress) * here.stress / here.rise;
    s += change;
    if (std::abs(change) <= close_enough * std::max(1.0, std::abs(s)))
      break;
  }
  return b * std::exp(s) + h * at(s).f;
}

} // namespace sheet
