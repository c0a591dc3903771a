// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/explain_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "libsheet/material/flow_curve.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/layer_scales.h"

namespace sheet::scene {
namespace {

// How viscosity goes with the rate.
std::string power_of_rate(double flow_index) {
  return fmt::format("{} as rate^{}", flow_index < 1 ? "falling" : "rising", brief(flow_index - 1));
}

double viscosity_at(const Liquid& liquid, double rate) { return viscosity_of(liquid, {rate * rate}); }

// The rates at which the scene strains its liquid, from a tenth of the least that is known.
struct Rates {
  double least = 0, greatest = 0; // [1/s]; 0: none is known
};
Rates rates_of(const Scene& scene, const Scales& scales) {
  Rates rates;
  const auto add = [&](double rate) {
    constexpr double below = 0.1;
    if (!(rate > 0) || !std::isfinite(rate))
      return;
    rates.least = rates.least > 0 ? std::min(rates.least, below * rate) : below * rate;
    rates.greatest = std::max(rates.greatest, rate);
  };
  add(scales.rate().value_or(0));
  if (const auto layer = layer_scales_of(scene, scales))
    add(layer->speed / *scales.thickness);
  return rates;
}

DimensionlessNumber thinning(const Liquid& liquid, const Rates& rates) {
  const double slow = viscosity_at(liquid, rates.least), fast = viscosity_at(liquid, rates.greatest);
  const double ratio = slow / fast;
  constexpr double alike = 1.1;
  const std::string from_to = fmt::format("from {} to {} 1/s", brief(rates.least), brief(rates.greatest));
  return {"thinning", "mu at a tenth of the least rate / mu at the greatest one", ratio,
          ratio < alike && ratio > 1 / alike
              ? fmt::format("Here it is as good as Newtonian: {} Pa s {}.", brief(fast), from_to)
              : fmt::format("At rates {} its viscosity {} from {} to {} Pa s.", from_to, ratio > 1 ? "falls" : "rises",
                            brief(slow), brief(fast))};
}

DimensionlessNumber bingham(const Liquid& liquid, double rate) {
  const bool power = liquid.law.kind == FlowLawKind::herschel_bulkley;
  const double flowing =
      power ? liquid.viscosity * rate * std::pow(rate / liquid.law.reference_rate, liquid.law.flow_index - 1)
            : liquid.viscosity * rate;
  const double number = liquid.law.yield_stress / flowing;
  return {"Bingham", power ? "tau_y / (K (V / L)^n)" : "tau_y L / (mu V), mu the scene's viscosity", number,
          number < 0.1 ? "So fast it flows as if there were no yield stress."
          : number < 10
              ? "Yield stress and viscosity both matter."
              : "The yield stress rules: it flows in few places, and what is between goes along like a solid."};
}

DimensionlessNumber weight_against_yield(const Scene& scene, const Scales& scales) {
  const double rho = scene.material.density, yield = scene.material.law.yield_stress;
  const double hangs = std::numbers::sqrt3 * yield / (rho * scales.gravity);
  return {"weight against yield", "rho g L / tau_y", rho * scales.gravity * *scales.length / yield,
          fmt::format("Hung up, it flows where more than sqrt(3) tau_y / (rho g) = {} m hangs: {} m {}.", brief(hangs),
                      brief(*scales.length), *scales.length > hangs ? "flow" : "stand")};
}

DimensionlessNumber layer_against_yield(const Scene& scene, const Scales& scales, const LayerScales& layer) {
  const double yield = scene.material.law.yield_stress, weight = scene.material.density * scales.gravity;
  const double h = *scales.thickness;
  if (layer.along > 1e-6 * scales.gravity) {
    const double stays = yield / (scene.material.density * layer.along);
    return {"layer against yield", "rho g_t h / tau_y", h / stays,
            fmt::format("Down the steepest solid a layer of {} m {}; below tau_y / (rho g_t) = {} m it stands.",
                        brief(h),
                        h > stays              ? "flows"
                        : layer.stress > yield ? "stands, but for its rim"
                                               : "stands",
                        brief(stays))};
  }
  return {"layer against yield", "rho g h² / (L tau_y)", layer.stress / yield,
          fmt::format("A layer of {} m and this length {}; below sqrt(tau_y L / (rho g)) = {} m it stands.", brief(h),
                      layer.stress > yield ? "spreads" : "stands", brief(std::sqrt(yield * *scales.length / weight)))};
}

DimensionlessNumber tension_against_yield(const Scene& scene, double thickness) {
  const double number = scene.material.surface_tension / (scene.material.law.yield_stress * thickness);
  return {"tension against yield", "gamma / (tau_y h)", number,
          number > 1 ? "Surface tension draws a rim back, until it is gamma / tau_y thick."
                     : "Surface tension does not move it: a rim stays where it is."};
}

} // namespace

std::string law_in_words(const Liquid& liquid) {
  const FlowLaw& law = liquid.law;
  const std::string mu = brief(liquid.viscosity) + " Pa s", stands = "stands below " + brief(law.yield_stress) + " Pa";
  const auto plateaus = [&](std::string_view name) {
    return fmt::format("{}: {} where slow, {} beyond {} 1/s{}", name, mu, power_of_rate(law.flow_index),
                       brief(1 / law.time_constant),
                       law.infinite_viscosity > 0 ? fmt::format(" to {} Pa s", brief(law.infinite_viscosity)) : "");
  };
  switch (law.kind) {
  case FlowLawKind::newtonian:
    break;
  case FlowLawKind::power:
    return fmt::format("power law: {} at {} 1/s, {}", mu, brief(law.reference_rate), power_of_rate(law.flow_index));
  case FlowLawKind::carreau:
    return plateaus("Carreau");
  case FlowLawKind::cross:
    return plateaus("Cross");
  case FlowLawKind::bingham:
    return fmt::format("Bingham: {}; what is above flows with {}", stands, mu);
  case FlowLawKind::herschel_bulkley:
    return fmt::format("Herschel-Bulkley: {}; what is above flows with {} at {} 1/s, {}", stands, mu,
                       brief(law.reference_rate), power_of_rate(law.flow_index));
  case FlowLawKind::casson:
    return fmt::format("Casson: {}, thins towards {}", stands, mu);
  case FlowLawKind::table:
    return fmt::format("table: {} Pa s at {} 1/s to {} Pa s at {} 1/s, in {} rows", brief(law.viscosities.front()),
                       brief(law.rates.front()), brief(law.viscosities.back()), brief(law.rates.back()),
                       law.rates.size());
  }
  return {};
}

std::vector<Scale> scales_of_law(const Scene& scene, const Scales& scales) {
  std::vector<Scale> list;
  if (scene.material.law.newtonian())
    return list;
  if (const auto rate = scales.rate())
    list.push_back({"mu_V", "viscosity of the flow", scales.viscosity, "Pa s",
                    fmt::format("the law's at V / L = {} 1/s", brief(*rate))});
  if (const auto layer = layer_scales_of(scene, scales); layer && layer->speed > 0)
    list.push_back({"mu_U", "viscosity of the layer", layer->viscosity, "Pa s",
                    fmt::format("the law's at U / h = {} 1/s", brief(layer->speed / *scales.thickness))});
  return list;
}

std::optional<std::string> warning_of_rest_rate(const Scene& scene, const Scales& scales) {
  constexpr double near = 10; // times the rest rate
  const double rest = rest_rate(scene.material);
  const auto rate = scales.rate();
  if (scene.material.law.kind != FlowLawKind::power || !rate || *rate > near * rest)
    return {};
  return fmt::format("the flow's rate V / L = {} 1/s is not far above the rest rate {} 1/s, below which the liquid is "
                     "Newtonian: give viscosity at a reference_rate that the scene has, or a smaller rest_rate",
                     brief(*rate), brief(rest));
}

std::vector<DimensionlessNumber> numbers_of_law(const Scene& scene, const Scales& scales) {
  std::vector<DimensionlessNumber> list;
  const Liquid& liquid = scene.material;
  if (liquid.law.newtonian())
    return list;
  if (const Rates rates = rates_of(scene, scales); rates.greatest > 0)
    list.push_back(thinning(liquid, rates));
  if (!liquid.law.yields() || !scales.length)
    return list;
  if (const auto rate = scales.rate())
    list.push_back(bingham(liquid, *rate));
  if (scales.gravity > 0 && liquid.density > 0)
    list.push_back(weight_against_yield(scene, scales));
  if (const auto layer = layer_scales_of(scene, scales))
    list.push_back(layer_against_yield(scene, scales, *layer));
  if (scales.thickness && liquid.surface_tension > 0)
    list.push_back(tension_against_yield(scene, *scales.thickness));
  return list;
}

} // namespace sheet::scene
