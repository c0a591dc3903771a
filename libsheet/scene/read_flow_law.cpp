// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/read_flow_law.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "libsheet/material/flow_curve.h"
#include "libsheet/scene/read_curve.h"
#include "libsheet/scene/words.h"

namespace sheet::scene {
namespace {

constexpr int looked_at_between = 8;                       // places between two rows of a table
constexpr double least_rate = 1e-50, greatest_rate = 1e50; // at which a law bends [1/s], far from where numbers end
constexpr double sharpest = 20;                            // transition

// The first rate from which on the stress falls, if there is one: no steady flow is stable there.
std::optional<double> falls_from(const Liquid& liquid) {
  const FlowCurve curve(liquid);
  const std::vector<double>& rates = liquid.law.rates;
  for (std::size_t i = 0; i + 1 < rates.size(); ++i)
    for (int k = 0; k < looked_at_between; ++k) {
      const double rate = rates[i] * std::pow(rates[i + 1] / rates[i], k / double{looked_at_between});
      if (curve.tangent_viscosity({rate * rate}) < 0)
        return rate;
    }
  return {};
}

constexpr CurveKeys flow_curve_keys{"rates",
                                    "viscosities",
                                    "file",
                                    "[0.1, 1, 10, 100]",
                                    "[\"20 Pa*s\", 8, 3, 1.5]",
                                    {{{"rate", quantity::strain_rate}, {"viscosity", quantity::viscosity}}},
                                    "rate [1/s], viscosity [Pa*s]"};

void read_table(TableReader& table, const Files& files, Liquid& liquid) {
  const bool by_file = !table.absent("file");
  auto curve = read_curve(table, files, flow_curve_keys);
  liquid.viscosity = std::numeric_limits<double>::quiet_NaN();
  if (!curve)
    return; // reported
  if (curve->places.front() < least_rate || curve->places.back() > greatest_rate)
    return table.wrong(by_file ? "file" : "rates",
                       fmt::format("expected rates from {:g} to {:g} 1/s", least_rate, greatest_rate));
  liquid.law.rates = std::move(curve->places);
  liquid.law.viscosities = std::move(curve->values);
  if (const auto rate = falls_from(liquid))
    table.wrong(
        by_file ? "file" : "viscosities",
        fmt::format(
            "{}the stress falls as the rate grows, at {:.3g} 1/s: the viscosity must not fall faster than 1/rate",
            by_file ? "in its rows " : "", *rate));
  else
    liquid.viscosity = viscosity_of(liquid, {liquid.law.reference_rate * liquid.law.reference_rate});
}

double read_index(TableReader& table, double below) {
  const double index = table.required("flow_index");
  if (index >= below)
    table.wrong("flow_index", fmt::format("expected less than {:g}", below));
  return index;
}

// Those of carreau and cross.
void read_plateaus(TableReader& table, Liquid& liquid, double index_below) {
  liquid.viscosity = table.required("zero_viscosity");
  liquid.law.infinite_viscosity = table.quantity_or("infinite_viscosity", 0, Bound::not_negative);
  liquid.law.time_constant = table.required("time_constant");
  if (liquid.law.time_constant < 1 / greatest_rate || liquid.law.time_constant > 1 / least_rate)
    table.wrong("time_constant", fmt::format("expected a time from {:g} to {:g} s", 1 / greatest_rate, 1 / least_rate));
  liquid.law.flow_index = read_index(table, index_below);
  if (liquid.law.infinite_viscosity >= liquid.viscosity)
    table.wrong("infinite_viscosity", "expected less than zero_viscosity: the liquid thins from that to this");
}

void read_power(TableReader& table, Liquid& liquid) {
  liquid.law.flow_index = read_index(table, std::numeric_limits<double>::infinity());
  liquid.law.reference_rate = table.quantity_or("reference_rate", 1, Bound::positive);
}

constexpr std::array<std::string_view, words::flow_laws.size()> keys_of_laws{
    "viscosity alone",
    "viscosity, flow_index, reference_rate, rest_rate",
    "zero_viscosity, infinite_viscosity, time_constant, flow_index, transition",
    "zero_viscosity, infinite_viscosity, time_constant, flow_index",
    "viscosity, yield_stress, rest_rate",
    "viscosity, yield_stress, flow_index, reference_rate, rest_rate",
    "viscosity, yield_stress, rest_rate",
    "rates, viscosities, file, reference_rate"};

} // namespace

void read_flow_law(TableReader& table, const Files& files, Liquid& liquid) {
  FlowLaw& law = liquid.law;
  const std::size_t choice = table.choice("law").value_or(0);
  law.kind = static_cast<FlowLawKind>(choice);
  switch (law.kind) {
  case FlowLawKind::newtonian:
    if (has_viscosity(liquid.temperature_law)) {
      liquid.viscosity = reference_viscosity(liquid.temperature_law).value_or(0); // 0: rows that are reported
      table.has_no_meaning({"viscosity"}, "viscosity_law has it, by temperature");
    } else {
      liquid.viscosity = table.required("viscosity", Bound::not_negative);
    }
    break;
  case FlowLawKind::carreau:
    read_plateaus(table, liquid, std::numeric_limits<double>::infinity());
    law.transition = table.quantity_or("transition", 2, Bound::positive);
    if (law.transition > sharpest)
      table.wrong("transition", fmt::format("expected at most {:g}, which is as sharp as a corner", sharpest));
    break;
  case FlowLawKind::cross:
    read_plateaus(table, liquid, 1);
    break;
  case FlowLawKind::table:
    law.reference_rate = table.quantity_or("reference_rate", 1, Bound::positive);
    read_table(table, files, liquid);
    break;
  default:
    liquid.viscosity = table.required("viscosity");
    if (law.yields())
      law.yield_stress = table.required("yield_stress");
    if (law.kind == FlowLawKind::power || law.kind == FlowLawKind::herschel_bulkley)
      read_power(table, liquid);
    law.rest_rate = table.quantity("rest_rate", Bound::positive);
  }
  table.has_no_meaning({"viscosity", "flow_index", "yield_stress", "reference_rate", "zero_viscosity",
                        "infinite_viscosity", "time_constant", "transition", "rates", "viscosities", "file",
                        "rest_rate"},
                       fmt::format("law \"{}\" takes {}", words::flow_laws[choice], keys_of_laws[choice]));
}

} // namespace sheet::scene
