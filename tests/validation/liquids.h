// SPDX-License-Identifier: GPL-3.0-or-later
// Liquids that are not Newtonian, for cases where all of the sheet is strained alike: its stress τ and rate γ̇ then go
// with its size Y, a length or a radius, as τ = τ1 Y^k and γ̇ = c Y'/Y.
#pragma once
#include <functional>

#include "tests/validation/setup.h"

namespace sheet::validation {

// Of the sets of V30: power laws of the indices 1/3, 1/2 and 3/2, then a Bingham liquid that yields at half of the
// first stress, each of the rate `rate` at that stress.
struct TestedLiquid {
  Liquid liquid;
  std::function<double(double stress)> rate; // exact [1/s]
};
inline constexpr int tested_liquids = 4;
inline constexpr double tested_stress = 250;                                      // at the start [Pa]
[[nodiscard]] TestedLiquid tested_liquid(int number, double stress, double rate); // from 0

struct Growth {
  double stress, power, rate; // τ1, k, c
};
// The time in which Y grows from 1 to `end`.
[[nodiscard]] double time_of_growth(const TestedLiquid& liquid, const Growth& growth, double end);

// V5 and V6 of such a liquid, the length grows from 1 to `end`.
[[nodiscard]] Result pulled_strip(const Settings& s, bool width_held, const TestedLiquid& liquid, double end);

// V7 of any liquid: a tube of the radius 1 and thickness h under the pressure p, which grows at the rate `rate` at
// first, to the radius `end`.
[[nodiscard]] Result blown_tube(const Settings& s, const Liquid& liquid, double h, double p, double rate, double until,
                                double end);

} // namespace sheet::validation
