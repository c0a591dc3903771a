// SPDX-License-Identifier: GPL-3.0-or-later
// What the law of a liquid means for a scene, for explain.cpp and plan/modelled.cpp. Nothing of Newtonian ones.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "libsheet/scene/explain.h"
#include "libsheet/scene/scales.h"

namespace sheet::scene {

// The law with its numbers, in words: "Bingham: stands below 20 Pa, ...".
[[nodiscard]] std::string law_in_words(const Liquid& liquid);

// Viscosities at the rates V/L and U/h (layer_scales.h) [Pa s].
[[nodiscard]] std::vector<Scale> scales_of_law(const Scene& scene, const Scales& scales);

// Of a power law that the scene strains so slowly that it is Newtonian: below its rest rate.
[[nodiscard]] std::optional<std::string> warning_of_rest_rate(const Scene& scene, const Scales& scales);

// With the yield stress tau_y:
//   thinning                 mu at a tenth of the least rate over mu at the greatest one, of V/L and U/h
//   Bingham                  tau_y L/(mu V), of Herschel-Bulkley tau_y/(K (V/L)^n): 1 where both parts are alike
//   weight against yield     rho g L/tau_y; a strip hung up flows where more than sqrt(3) tau_y/(rho g) hangs
//                            (its stress in tension is sqrt(3) tau_y [von Mises 1913])
//   layer against yield      rho g_t h/tau_y on an incline, where it stands below 1; rho g h²/(L tau_y) on the level
//   tension against yield    gamma/(tau_y h); above 1 a rim is drawn back
[[nodiscard]] std::vector<DimensionlessNumber> numbers_of_law(const Scene& scene, const Scales& scales);

} // namespace sheet::scene
