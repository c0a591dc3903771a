// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/driven_rate.h"

#include <cmath>
#include <limits>

namespace sheet {

double driven_rate(const Liquid& liquid, double stress) { return driven_rate(liquid, FlowCurve(liquid), stress); }

double driven_rate(const Liquid& liquid, const FlowCurve& curve, double stress) {
  if (liquid.law.newtonian())
    return liquid.viscous() ? stress / liquid.viscosity : std::numeric_limits<double>::infinity();
  if (stress <= liquid.law.yield_stress)
    return 0;
  double low = -100, high = 100; // ln γ̇: the stress rises with the rate, so bisection finds it
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (curve.stress(std::exp(middle)) < stress ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

double stretching_rate(const Liquid& liquid, double tension, double borne) {
  return liquid.law.newtonian() || tension > borne * liquid.law.yield_stress ? driven_rate(liquid, tension) : 0;
}

} // namespace sheet
