// SPDX-License-Identifier: GPL-3.0-or-later
// The unit in which numbers are easy to read.
#pragma once
#include <string_view>
#include <vector>

namespace sheet {

struct ScaledUnit {
  std::string_view name; // UTF-8
  double size;           // in SI
};

// The units for a quantity that has this one in SI, from large to small: "m", "mm", ...; the unit alone if it has no
// others.
[[nodiscard]] std::vector<ScaledUnit> scaled_units(std::string_view unit);

// The first of them that is not larger than `largest`, which no number exceeds; else the last.
[[nodiscard]] ScaledUnit fitting_unit(std::string_view unit, double largest);

} // namespace sheet
