// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/gas.h"

#include <array>
#include <cmath>

namespace sheet {

namespace {

struct Node {
  double place, weight; // in (0, 1)
};
// Gauss-Legendre, 8 points [Abramowitz and Stegun 1964, table 25.4], moved to (0, 1).
constexpr std::array<Node, 4> nodes = {{{0.1834346424956498, 0.3626837833783620},
                                        {0.5255324099163290, 0.3137066458778873},
                                        {0.7966664774136267, 0.2223810344533745},
                                        {0.9602898564975363, 0.1012285362903763}}};

double excess(const GasLaw& law, double amount, double volume) {
  return law.ambient * std::expm1(law.exponent * std::log(amount / volume));
}

// m + c τ p(m) = reference: p grows with m and, as n >= 1, is convex, so that Newton's method comes down to the root
// after its first step.
double amount_after_leak(const GasLaw& law, double volume, double reference, double tau) {
  if (law.leak == 0)
    return reference;
  constexpr int most_iterations = 60;
  double m = volume; // there p = 0
  for (int k = 0; k < most_iterations; ++k) {
    const double p = excess(law, m, volume);
    const double slope = 1 + law.leak * tau * law.exponent * (law.ambient + p) / m;
    const double change = (reference - m - law.leak * tau * p) / slope;
    m = m + change > 0 ? m + change : 0.5 * m;
    if (std::abs(change) <= 1e-15 * m)
      break;
  }
  return m;
}

} // namespace

Gas gas_in(const GasLaw& law, double volume, double reference, double tau) {
  Gas gas;
  if (!(volume > 0))
    return {std::nan(""), std::nan(""), std::nan("")};
  gas.amount = amount_after_leak(law, volume, reference, tau);
  gas.pressure = excess(law, gas.amount, volume);
  const double whole = law.exponent * (law.ambient + gas.pressure);
  gas.stiffness = whole / volume / (1 + law.leak * tau * whole / gas.amount);
  return gas;
}

double mean_pressure(const GasLaw& law, double from, double to, double reference, double tau) {
  if (!(to > 0))
    return std::nan("");
  const double change = (to - from) / from;
  const double span = std::log1p(change); // ∫ p dΩ = ∫ p Ω ds, s = log(Ω/from)
  double sum = 0;
  for (const Node& node : nodes)
    for (const double side : {-1.0, 1.0}) {
      const double volume = from * std::exp(0.5 * span * (1 + side * node.place));
      sum += 0.5 * node.weight * gas_in(law, volume, reference, tau).pressure * volume / from;
    }
  return change == 0 ? sum : sum * span / change;
}

double amount_of_gas(const GasLaw& law, double pressure, double volume) {
  return volume * std::exp(std::log1p(pressure / law.ambient) / law.exponent);
}

} // namespace sheet
