// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/quantities/scaled_unit.h"

#include <algorithm>
#include <map>

namespace sheet {

std::vector<ScaledUnit> scaled_units(std::string_view unit) {
  static const std::map<std::string_view, std::vector<ScaledUnit>> known = {
      {"m", {{"km", 1e3}, {"m", 1}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}}},
      {"m/s", {{"m/s", 1}, {"mm/s", 1e-3}, {"µm/s", 1e-6}, {"nm/s", 1e-9}}},
      {"1/m", {{"1/mm", 1e3}, {"1/m", 1}, {"1/km", 1e-3}}},
      {"m^2", {{"m²", 1}, {"cm²", 1e-4}, {"mm²", 1e-6}}},
      {"m^3", {{"m³", 1}, {"l", 1e-3}, {"ml", 1e-6}}},
      {"J", {{"J", 1}, {"mJ", 1e-3}, {"µJ", 1e-6}}},
      {"1", {{"", 1}}},
  };
  const auto found = known.find(unit);
  return found != known.end() ? found->second : std::vector{ScaledUnit{unit, 1}};
}

ScaledUnit fitting_unit(std::string_view unit, double largest) {
  const std::vector<ScaledUnit> units = scaled_units(unit);
  const auto fits = std::ranges::find_if(units, [&](const ScaledUnit& u) { return largest >= u.size; });
  return fits == units.end() ? units.back() : *fits;
}

} // namespace sheet
