// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/log_spline.h"

#include <cmath>

namespace sheet {

namespace {

// Of ln P over ln v, in intervals.
struct Knot {
  double value, first, second;
};

// The quintic with the values and two derivatives of its ends.
std::array<double, 6> quintic(const Knot& from, const Knot& to) {
  const double half = from.second / 2;
  const double value = to.value - from.value - from.first - half; // what is left to the end
  const double first = to.first - from.first - from.second, second = to.second - from.second;
  return {from.value,
          from.first,
          half,
          10 * value - 4 * first + second / 2,
          7 * first - 15 * value - second,
          6 * value - 3 * first + second / 2};
}

} // namespace

LogSpline::LogSpline(double first, double last, double interval, const std::function<Point(double v)>& at)
    : first_(first) {
  const auto intervals = static_cast<std::size_t>(std::ceil((last - first) / interval));
  interval_ = (last - first) / static_cast<double>(intervals);
  const auto knot = [&](std::size_t row) {
    const double v = std::exp(first_ + interval_ * static_cast<double>(row));
    const Point point = at(v);
    const double slope = v * point.first / point.value;
    const double curvature = slope + v * v * point.second / point.value - slope * slope;
    return Knot{std::log(point.value), interval_ * slope, interval_ * interval_ * curvature};
  };
  Knot from = knot(0);
  for (std::size_t i = 0; i < intervals; ++i) {
    const Knot to = knot(i + 1);
    coefficients_.push_back(quintic(from, to));
    from = to;
  }
}

bool LogSpline::covers(double log_v) const {
  return log_v >= first_ && log_v < first_ + interval_ * static_cast<double>(coefficients_.size());
}

LogSpline::Point LogSpline::at(double v, double log_v) const {
  const double place = (log_v - first_) / interval_;
  const auto row = static_cast<std::size_t>(place);
  const double x = place - static_cast<double>(row);
  const auto& c = coefficients_[row < coefficients_.size() ? row : coefficients_.size() - 1];
  const double value = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
  const double slope = (c[1] + x * (2 * c[2] + x * (3 * c[3] + x * (4 * c[4] + x * 5 * c[5])))) / interval_;
  const double curvature = (2 * c[2] + x * (6 * c[3] + x * (12 * c[4] + x * 20 * c[5]))) / (interval_ * interval_);
  const double p = std::exp(value);
  return {p, p * slope / v, p * (curvature + slope * (slope - 1)) / (v * v)};
}

} // namespace sheet
