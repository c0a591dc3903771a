// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/films.h"

#include <algorithm>

namespace sheet {

namespace {
constexpr double of_strip = 0.25;    // μ h/τ of this part of 2 γ and
constexpr double of_triangle = 0.03; // ρ h A/τ² of this part let tension shorten a film by a tenth in a stage
} // namespace

std::vector<double> stiffened_films(const Stage& stage, bool inertia) {
  std::vector<double> raised;
  const bool tense =
      std::ranges::any_of(stage.liquids, [](const StageLiquid& of) { return of.liquid.surface_tension > 0; });
  if (!(stage.viscous() && tense))
    return raised;
  const std::vector<double>& volumes = stage.start->volumes;
  double volume = 0, area = 0;
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    volume += volumes[t];
    area += stage.raised[t].area();
  }
  const double thin = film_thickness * volume / area, tau = stage.duration;
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    const double own = stage.raised[t].area(), h = volumes[t] / own;
    const double density = inertia ? stage.liquid_of(t).liquid.density : 0;
    const double pull = 2 * stage.surface_tension(t) - of_triangle * density * h * own / (tau * tau);
    const double excess = pull * tau / (of_strip * stage.viscosity[t] * h) - 1;
    if (h >= thin || !(excess > 0))
      continue;
    raised.resize(volumes.size(), 1);
    raised[t] = 1 + excess * (1 - h / thin);
  }
  return raised;
}

} // namespace sheet
