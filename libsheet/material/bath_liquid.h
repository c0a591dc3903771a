// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid below the height `level`, measured against gravity from the origin. It carries what is under its surface, and
// pulls down what is above it if it clings. What floats on it spreads under its own weight where that is asked for, and
// is dragged where it slides.
#pragma once

namespace sheet {

struct BathLiquid {
  double density = 0; // [kg/m³]
  double level = 0;   // [m]
  bool clings = false;
  bool spreads = false;
  double drag = 0; // of a square metre that slides on it, over its speed [Pa s/m]
  bool operator==(const BathLiquid&) const = default;
};

} // namespace sheet
