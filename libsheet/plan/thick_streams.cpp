// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/thick_streams.h"

#include <cstddef>

#include <fmt/format.h>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/inlet_width.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/piling.h"
#include "libsheet/scene/brief.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

constexpr double narrow = 8;     // thicknesses
constexpr double well_after = 2; // times that in which a fold closes, of what is proposed
constexpr double well_before = 0.2;

} // namespace

std::string thick_stream_warning(const Scene& scene, const formats::Frame& first, double until) {
  if (scene.merge || !scene.contact || !scene.contact->self)
    return {};
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const auto landing = landing_of_inflow(scene, first, i);
    const double h = scene.inflows[i].thickness;
    if (!landing || scene.solids[landing->solid].contact != SolidContact::flow ||
        !inflow_piles_up(scene, first, i, *landing))
      continue;
    const Liquid& liquid = landing->liquid;
    const double width = width_of_inlet(first, i);
    const double closing = 1 / driven_rate(liquid, liquid.density * scene.environment.gravity->norm() * h);
    if (width <= narrow * h && well_after * closing <= well_before * until)
      return fmt::format("inflow {}, {} m wide and {} m thick, piles up on {} in folds that its weight closes within "
                         "{:.1g} s, but layers stay layers: [merge] after = \"{:.1g} s\" makes them one",
                         i, scene::brief(width), scene::brief(h), solid::Solids(scene).name(landing->solid), closing,
                         well_after * closing);
  }
  return {};
}

} // namespace sheet
