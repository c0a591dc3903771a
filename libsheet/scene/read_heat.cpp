// SPDX-License-Identifier: GPL-3.0-or-later
// [heat]
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "libsheet/scene/tables.h"

namespace sheet::scene {
namespace {

constexpr int most_modes = 8; // heat/profile.h

// Constant, rows over time, or rows along an axis of the world; as `otherwise` if it is absent or wrong.
Varying read_varying(TableReader& table, std::string_view key, const Varying& otherwise, Bound bound) {
  const Node* value = table.take(key);
  if (value == nullptr || value->type != Node::Type::table) {
    auto timed = table.timed_number(key, bound);
    return timed ? Varying(std::move(*timed)) : otherwise;
  }
  auto source = *table.table(key);
  for (const auto& [needed, example] : {std::pair("along", "\"x\""), std::pair("rows", "[[0, 300], [\"0.1 m\", 900]]")})
    if (source.absent(needed))
      source.missing(needed, example);
  AlongAxis along{static_cast<int>(source.choice("along").value_or(0)), {}};
  along.rows = read_place_rows(source, "rows", "the value", "[\"0.1 m\", 900]", bound);
  source.finish();
  return along.rows.size() < 2 ? otherwise : Varying(std::move(along)); // reported
}

// Keys that are absent are as in `both`.
HeatedFace read_face(TableReader& table, const HeatedFace& both, bool has_ambient) {
  HeatedFace face = both;
  const bool told = !table.absent("ambient");
  face.ambient = read_varying(table, "ambient", both.ambient, Bound::positive);
  face.transfer = read_varying(table, "transfer", both.transfer, Bound::not_negative);
  face.emissivity = table.quantity_or("emissivity", both.emissivity, Bound::not_negative);
  if (face.emissivity > 1)
    table.wrong("emissivity", "expected a part from 0 to 1");
  const Varying seen = told || !has_ambient ? face.ambient : both.radiant;
  face.radiant = read_varying(table, "radiant", seen, Bound::positive);
  if (face.exchanges() && !told && !has_ambient)
    table.missing("ambient", "\"20 degC\"");
  return face;
}

} // namespace

Heat read_heat(TableReader table) {
  Heat heat;
  heat.specific_heat = table.required("specific_heat");
  heat.conductivity = table.quantity_or("conductivity", 0, Bound::not_negative);
  heat.temperature = table.required("temperature");
  if (const auto profile = table.seed("profile")) {
    heat.profile = static_cast<int>(*profile);
    if (*profile < 1 || *profile > most_modes)
      table.wrong("profile", fmt::format("expected 1 to {} modes", most_modes));
    else if (heat.conductivity == 0)
      table.wrong("profile", "needs conductivity, which makes one across the thickness");
  }
  const bool has_ambient = !table.absent("ambient");
  const HeatedFace both = read_face(table, {}, has_ambient);
  heat.upper = heat.lower = both;
  for (const bool is_upper : {true, false}) {
    if (auto face = table.table(is_upper ? "upper" : "lower")) {
      (is_upper ? heat.upper : heat.lower) = read_face(*face, both, has_ambient);
      face->finish();
    }
  }
  for (HeatedFace* face : {&heat.upper, &heat.lower})
    if (!face->exchanges())
      *face = {};
  heat.viscous_heating = table.boolean("viscous_heating").value_or(false);
  table.finish();
  return heat;
}

} // namespace sheet::scene
