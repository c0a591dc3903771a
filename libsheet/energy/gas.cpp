// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/gas.h"

#include <algorithm>
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

constexpr double orifice = 0.61; // C_d, π/(π + 2) [Kirchhoff 1869]

// k [m³/(s √Pa)]
double hole_conductance(const GasLaw& law) { return orifice * law.hole * std::sqrt(2 / law.outside); }

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

// s of p = s |s|, from Ω ((1 + p/p_a)^(1/n) - 1) + c τ p + k τ s = reference - Ω, which grows with s, and is between 0
// and what it would be without leak and hole.
double root_of_pressure(const GasLaw& law, double volume, double reference, double tau) {
  constexpr int most_iterations = 100;
  const double more = reference - volume, through = tau * hole_conductance(law);
  const double whole = excess(law, reference, volume);
  double low = std::min(0.0, -std::sqrt(std::max(0.0, -whole))), high = std::sqrt(std::max(0.0, whole));
  double s = std::clamp(more / through, low, high);
  for (int k = 0; k < most_iterations; ++k) {
    const double p = s * std::abs(s), part = std::log1p(p / law.ambient) / law.exponent;
    const double f = volume * std::expm1(part) + law.leak * tau * p + through * s - more;
    (f > 0 ? high : low) = s;
    const double filled = volume * std::exp(part) / (law.exponent * (law.ambient + p)); // dm/dp at this volume
    const double next = s - f / (2 * std::abs(s) * (filled + law.leak * tau) + through);
    const double change = (next > low && next < high ? next : 0.5 * (low + high)) - s;
    if (f == 0 || std::abs(change) <= 1e-15 * std::abs(s))
      break;
    s += change;
  }
  return s;
}

Gas gas_with_hole(const GasLaw& law, double volume, double reference, double tau) {
  const double s = root_of_pressure(law, volume, reference, tau), through = tau * hole_conductance(law);
  Gas gas;
  gas.pressure = s * std::abs(s);
  gas.escaped = through * s;
  gas.amount = reference - law.leak * tau * gas.pressure - gas.escaped;
  const double filled = gas.amount / (law.exponent * (law.ambient + gas.pressure));
  gas.stiffness = gas.amount / volume * 2 * std::abs(s) / (2 * std::abs(s) * (filled + law.leak * tau) + through);
  return gas;
}

// ∫ p dΩ over ∫ dΩ along the s of root_of_pressure, where both are smooth but at s = 0.
double mean_with_hole(const GasLaw& law, double from, double to, double reference, double tau) {
  const double first = root_of_pressure(law, from, reference, tau), last = root_of_pressure(law, to, reference, tau);
  const double through = tau * hole_conductance(law);
  double work = 0, change = 0; // [J], [m³], both over the length of a single span
  const auto add = [&](double begin, double end, double length) {
    for (const Node& node : nodes)
      for (const double side : {-1.0, 1.0}) {
        const double s = begin + 0.5 * (end - begin) * (1 + side * node.place), p = s * std::abs(s);
        const double filled = std::exp(std::log1p(p / law.ambient) / law.exponent); // m/Ω
        const double volume = (reference - law.leak * tau * p - through * s) / filled;
        const double slope = 2 * std::abs(s) * (law.leak * tau / filled + volume / (law.exponent * (law.ambient + p))) +
                             through / filled; // -dΩ/ds
        work += 0.5 * node.weight * length * slope * p;
        change += 0.5 * node.weight * length * slope;
      }
  };
  if (first * last < 0) {
    add(first, 0, -first);
    add(0, last, last);
  } else
    add(first, last, 1);
  return work / change;
}

} // namespace

Gas gas_in(const GasLaw& law, double volume, double reference, double tau) {
  if (law.open)
    return {.amount = std::max(0.0, volume), .escaped = reference - std::max(0.0, volume)};
  if (!(volume > 0))
    return {std::nan(""), std::nan(""), std::nan("")};
  if (law.hole > 0)
    return gas_with_hole(law, volume, reference, tau);
  Gas gas;
  gas.amount = amount_after_leak(law, volume, reference, tau);
  gas.pressure = excess(law, gas.amount, volume);
  const double whole = law.exponent * (law.ambient + gas.pressure);
  gas.stiffness = whole / volume / (1 + law.leak * tau * whole / gas.amount);
  return gas;
}

double mean_pressure(const GasLaw& law, double from, double to, double reference, double tau) {
  if (law.open)
    return 0;
  if (!(to > 0))
    return std::nan("");
  if (law.hole > 0)
    return mean_with_hole(law, from, to, reference, tau);
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
