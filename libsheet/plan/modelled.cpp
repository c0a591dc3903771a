// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/modelled.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "libsheet/base/overloaded.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/explain_law.h"
#include "libsheet/solve/scene_model.h"

namespace sheet {

namespace {

using scene::brief;

std::string count(std::size_t n, std::string_view one) { return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s"); }

// What liquid does that touches the solids.
std::string what_touches(const std::vector<scene::Solid>& solids) {
  constexpr std::array<std::string_view, 3> does{"sticks", "flows along it, dragged", "slips along it without drag"};
  std::string text;
  for (std::size_t k = 0; k < does.size(); ++k) {
    const auto alike = std::ranges::count(solids, static_cast<SolidContact>(k), &scene::Solid::contact);
    if (alike == static_cast<std::ptrdiff_t>(solids.size()))
      return fmt::format("liquid that touches {}", does[k]);
    if (alike > 0)
      text += fmt::format("{}on {} of them liquid that touches {}", text.empty() ? "" : ", ", alike, does[k]);
  }
  return text;
}

std::string law_of(const scene::Pressure& pressure) {
  return std::visit(
      Overloaded{[](const scene::ConstantPressure& p) { return fmt::format("constant, {} Pa", brief(p.value)); },
                 [](const scene::InverseSquarePressure& p) {
                   return fmt::format("{} Pa at radius {} m, falling with its square", brief(p.value),
                                      brief(p.reference_radius));
                 },
                 [](const scene::DrainingPressure& p) {
                   return fmt::format("enclosed gas leaves at {} m³/s per Pa", brief(p.conductance));
                 },
                 [](const scene::GasPressure& p) {
                   const std::string start = p.amount ? fmt::format("that fills {} m³ outside", brief(*p.amount))
                                                      : fmt::format("of {} Pa at the start", brief(p.value));
                   const bool lasts = p.amount || p.leak > 0 || !(p.value > 0 && p.ambient > 0);
                   const double growth = std::pow(1 + p.value / p.ambient, 1 / p.exponent) - 1;
                   const std::string gone =
                       lasts ? "" : fmt::format(", none once its room has grown by {} %", brief(100 * growth));
                   return fmt::format("enclosed gas {}, {} Pa outside, p ~ V^-{}{}{}", start, brief(p.ambient),
                                      brief(p.exponent), gone,
                                      p.leak > 0 ? fmt::format(", leaving at {} m³/s per Pa", brief(p.leak)) : "");
                 }},
      pressure);
}

// Pressure acts.
std::string on_what(const Scene& scene) {
  if (!scene.environment.pressure_sheet.empty())
    return fmt::format(", on the sheet \"{}\" only", scene.environment.pressure_sheet);
  return scene::depends_on_volume(*scene.environment.pressure) && scene.sheets.size() > 1 ? ", in each sheet by itself"
                                                                                          : "";
}

std::string what_comes(const std::vector<scene::Inflow>& inflows) {
  if (inflows.size() != 1)
    return fmt::format("new liquid at {} borders", inflows.size());
  const scene::Inflow& inflow = inflows[0];
  return fmt::format("new liquid, {} m thick, {}", brief(inflow.thickness),
                     inflow.until ? fmt::format("until {} s", brief(*inflow.until)) : "without end");
}

std::string where_it_tears(const scene::Tear& tear) {
  std::vector<std::string> where;
  if (tear.below)
    where.push_back(fmt::format("where thinner than {} m", brief(*tear.below)));
  if (tear.inclusions)
    where.push_back(fmt::format("in holes at inclusions, {} 1/m³ in {} m, as thickness^-{}",
                                brief(tear.inclusions->number), brief(tear.inclusions->at_thickness),
                                brief(tear.inclusions->exponent)));
  if (tear.snap)
    where.push_back(fmt::format("strands narrower than {} m", brief(*tear.snap)));
  if (tear.drops)
    where.emplace_back("small pieces fly on as drops");
  return fmt::format("{}", fmt::join(where, "; "));
}

} // namespace

std::vector<scene::ModelledPart> modelled(const Scene& scene) {
  std::vector<scene::ModelledPart> parts;
  const Model model = model_of(scene);
  for (const TermEntry& term : term_table()) {
    const bool asked = term.asked(model);
    parts.push_back({term.name, asked, asked ? term.because(model) : term.because_not(model)});
    if (asked && term.name == "pressure") // which the scene says best
      parts.back().why = law_of(*scene.environment.pressure) + on_what(scene);
  }
  const auto part = [&](std::string_view name, bool is, std::string_view because, std::string_view because_not) {
    parts.push_back({name, is, std::string(is ? because : because_not)});
  };
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  if (liquids.size() > 1)
    part("liquids", true, count(liquids.size(), "liquid") + ", each in its own sheets; they exchange forces alone", "");
  for (const Liquid& liquid : liquids)
    if (!liquid.law.newtonian())
      part("flow law", true, scene::law_in_words(liquid), "");
  if (scene.heat)
    part("heat", true, scene::heat_in_words(scene), "");
  part("holds", !scene.holds.empty(), count(scene.holds.size(), "hold"), "no [[hold]]");
  part("solids", !scene.solids.empty(), count(scene.solids.size(), "solid") + "; " + what_touches(scene.solids),
       "no [[solid]]");
  part("inflow", !scene.inflows.empty(), what_comes(scene.inflows), "no [inflow]: the volume stays the same");
  part("outflow", !scene.outflows.empty(), count(scene.outflows.size(), "plane") + " beyond which the sheet ends",
       "no [[outflow]]: nothing leaves");
  part("tear", scene.tear.has_value(), scene.tear ? where_it_tears(*scene.tear) : "",
       "no [tear]: the sheet only thins");
  part("merge", scene.merge.has_value(),
       !scene.merge         ? ""
       : scene.merge->after ? fmt::format("layers that have touched for {} s become one", brief(*scene.merge->after))
                            : "layers that have touched for mu h/gamma become one",
       "no [merge]: layers stay two");
  return parts;
}

} // namespace sheet
