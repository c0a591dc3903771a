// SPDX-License-Identifier: GPL-3.0-or-later
// Flow curves that are sums of powers of y = s + t x, x = γ̇²:
//   η = η∞ + Σ a y^m,   φ = η∞ x/2 + Σ a (y^(m+1) - s^(m+1))/(2 t (m + 1)),   d = 2 dη/dx.
// Near rest, where the difference would cancel, it is the binomial series of (1 + t x/s)^(m+1) - 1.
#pragma once
#include <array>
#include <cmath>

#include "libsheet/material/flow_point.h"

namespace sheet {

struct PowerSum {
  static constexpr int series_terms = 14;
  static constexpr double near = 0.1; // t x/s below which the series is taken: to 1e-14

  struct Term {
    double factor = 0, exponent = 0;              // a [Pa s · s^2m], m
    double per_power = 0;                         // of y^(m+1) in φ, a/(2 t (m + 1))
    double at_rest = 0;                           // what it has at rest, per_power s^(m+1)
    std::array<double, series_terms> series = {}; // of a binomial coefficient over the one before
  };

  double infinite = 0;         // η∞ [Pa s]
  double shift = 1, slope = 1; // s, t
  int terms = 0;
  std::array<Term, 2> term = {};

  // The next term.
  void add(double factor, double exponent) {
    const double power = exponent + 1, per_power = factor / (2 * slope * power);
    Term next{factor, exponent, per_power, per_power * std::pow(shift, power)};
    for (int k = 0; k < series_terms; ++k)
      next.series[static_cast<std::size_t>(k)] = (power - k) / (k + 1);
    term[static_cast<std::size_t>(terms++)] = next;
  }
};

// At x. `Count` is that of the terms. Without branches, so that compilers take several x at once.
template <int Count> [[gnu::always_inline]] inline FlowPoint flow_point(const PowerSum& sum, double x) {
  const double part = sum.slope * x / sum.shift, y = sum.shift + sum.slope * x, log_y = std::log(y);
  FlowPoint point{0.5 * sum.infinite * x, sum.infinite, 0};
  for (int i = 0; i < Count; ++i) {
    const PowerSum::Term& term = sum.term[static_cast<std::size_t>(i)];
    const double power = std::exp(term.exponent * log_y), viscosity = term.factor * power;
    double series = 0;
    for (int k = PowerSum::series_terms - 1; k >= 0; --k)
      series = part * term.series[static_cast<std::size_t>(k)] * (1 + series);
    const double far = term.per_power * power * y - term.at_rest;
    point.potential += part < PowerSum::near ? term.at_rest * series : far;
    point.viscosity += viscosity;
    point.slope += 2 * term.exponent * sum.slope * viscosity / y;
  }
  return point;
}

// Of `count` x at once.
void flow_points(const PowerSum& powers, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes);

} // namespace sheet
