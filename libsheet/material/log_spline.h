// SPDX-License-Identifier: GPL-3.0-or-later
// A positive function P of a positive number v over many decades, known with two derivatives wherever one asks: ln P as
// a spline of ln v, quintics that share values and two derivatives at their ends. The derivatives of the spline are
// those of its values to round-off, so that what follows from the one potential stays one.
#pragma once
#include <array>
#include <functional>
#include <vector>

namespace sheet {

class LogSpline {
public:
  struct Point {
    double value = 0, first = 0, second = 0; // P, P', P''
  };
  LogSpline() = default; // of nothing
  // From ln v = `first` on, as far as `last`, in intervals no longer than `interval`.
  LogSpline(double first, double last, double interval, const std::function<Point(double v)>& at);

  // Whether v > 0 lies within.
  [[nodiscard]] bool covers(double log_v) const;
  // At a v that is covered, and its logarithm.
  [[nodiscard]] Point at(double v, double log_v) const;

private:
  double first_ = 0, interval_ = 1;
  std::vector<std::array<double, 6>> coefficients_; // of each interval, Σ c_k x^k, x from 0 to 1
};

} // namespace sheet
