// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/read_temperature_law.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "libsheet/scene/read_curve.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr std::array<std::string_view, words::temperature_laws.size()> keys_of_temperature_laws{
    "none of these",
    "reference_temperature, activation_energy",
    "reference_temperature, temperature_coefficient",
    "reference_temperature, vft_a, vft_b, vft_temperature",
    "reference_temperature, wlf_c1, wlf_c2",
    "reference_temperature, temperatures, temperature_viscosities, temperature_file"};

constexpr CurveKeys temperature_curve_keys{
    "temperatures",
    "temperature_viscosities",
    "temperature_file",
    "[\"700 degC\", \"800 degC\", ...]",
    "[\"4e6 Pa*s\", 2e5, ...]",
    {{{"temperature", quantity::temperature}, {"viscosity", quantity::viscosity}}},
    "temperature [degC], viscosity [Pa*s]"};

void read_rows(TableReader& table, const Files& files, TemperatureLaw& law) {
  if (auto curve = read_curve(table, files, temperature_curve_keys)) {
    law.temperatures = std::move(curve->places);
    law.viscosities = std::move(curve->values);
  }
}

void read_constants(TableReader& table, const Files& files, TemperatureLaw& law) {
  switch (law.kind) {
  case TemperatureLawKind::constant:
    break;
  case TemperatureLawKind::arrhenius:
    law.activation_energy = table.required("activation_energy");
    break;
  case TemperatureLawKind::exponential:
    law.temperature_coefficient = table.required("temperature_coefficient");
    break;
  case TemperatureLawKind::vft:
    law.vft_a = table.quantity("vft_a");
    law.vft_b = table.required("vft_b", Bound::positive, "\"4330.9 K\"");
    law.vft_temperature = table.required("vft_temperature", Bound::positive, "\"246.1 degC\"");
    break;
  case TemperatureLawKind::wlf:
    law.wlf_c1 = table.required("wlf_c1", Bound::positive, "17.44");
    law.wlf_c2 = table.required("wlf_c2", Bound::positive, "\"51.6 K\"");
    break;
  case TemperatureLawKind::table:
    read_rows(table, files, law);
    break;
  }
}

} // namespace

void read_temperature_law(TableReader& table, const Files& files, Liquid& liquid) {
  TemperatureLaw& law = liquid.temperature_law;
  const std::size_t choice = table.choice("viscosity_law").value_or(0);
  law.kind = static_cast<TemperatureLawKind>(choice);
  liquid.surface_tension_slope = table.quantity_or("surface_tension_slope", 0);
  if (!law.constant() || liquid.surface_tension_slope != 0)
    law.reference_temperature = table.required("reference_temperature");
  read_constants(table, files, law);
  if (!law.constant() && law.reference_temperature > 0 &&
      (law.kind != TemperatureLawKind::table || !law.temperatures.empty()))
    if (const TemperatureRange range = range_of(law);
        !std::isnan(range.lowest) && !range.holds(law.reference_temperature)) // else a constant is missing
      table.wrong("reference_temperature",
                  fmt::format("the law holds from {:.6g} to {:.6g} K", range.lowest, range.highest));
  table.has_no_meaning(
      {"activation_energy", "temperature_coefficient", "vft_a", "vft_b", "vft_temperature", "wlf_c1", "wlf_c2",
       "temperatures", "temperature_viscosities", "temperature_file"},
      fmt::format("viscosity_law \"{}\" takes {}", words::temperature_laws[choice], keys_of_temperature_laws[choice]));
  table.has_no_meaning({"reference_temperature"}, "it is that of viscosity_law, or of surface_tension_slope");
}

} // namespace sheet::scene
