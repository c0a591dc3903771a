// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

namespace sheet {

// A sum of energies and the sum of their magnitudes, which tells how much of it is round-off.
struct EnergySum {
  double value = 0, magnitude = 0; // [J]
  // [J] What rounding may have made of `value`.
  [[nodiscard]] double noise() const { return 1e-14 * magnitude; }
  void add(double w) { value += w, magnitude += std::abs(w); }
  void add(const EnergySum& s) { value += s.value, magnitude += s.magnitude; }
};

} // namespace sheet
