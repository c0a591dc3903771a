// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using formats::Frame;

// The greatest distance of a vertex from the nearest one that is held [m].
double hanging_length(const Frame& first) {
  const auto x = positions(first);
  const auto held = holds(first);
  double longest = 0;
  for (const std::size_t v : probes_of(first)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t w = 0; w < first.vertices; ++w)
      if (held[w] != 0)
        nearest = std::min(nearest, (x[v] - x[w]).norm());
    longest = std::max(longest, nearest);
  }
  return longest;
}

bool stands_for_ever(const scene::Hold& hold) {
  return !hold.until && !hold.roll && hold.axes == all_axes && std::holds_alternative<scene::Fixed>(hold.motion);
}

bool hangs_by_its_weight(const Scene& scene) {
  const scene::Environment& around = scene.environment;
  return scene.sheets.size() == 1 && around.gravity && scene.material.density > 0 && scene.material.viscous() &&
         !around.pressure && !around.bath && !scene.heat && scene.inflows.empty() && !scene.holds.empty() &&
         std::ranges::all_of(scene.holds, stands_for_ever);
}

// The integral of 1/rate(stress l/3) over ln l from the start on.
double time_under(const Liquid& liquid, double stress) {
  constexpr double step = 0.05, enough = 1e-4; // of ln l; of what is summed up
  double time = 0, part = 0, at = 0.5 * step;
  do {
    part = step / driven_rate(liquid, stress / 3 * std::exp(at));
    time += part;
    at += step;
  } while (part > enough * time);
  return time;
}

} // namespace

std::optional<double> runaway_time(const Scene& scene, const Frame& first) {
  if (!hangs_by_its_weight(scene) || !landings(scene, first).empty())
    return {};
  const double stress = scene.material.density * scene.environment.gravity->norm() * hanging_length(first);
  const double tension = 2 * scene.material.surface_tension / *measured(first).thickness;
  if (!(stress > tension) || !(driven_rate(scene.material, stress / 3) > 0))
    return {};
  return scene.material.law.newtonian() ? 3 * scene.material.viscosity / stress : time_under(scene.material, stress);
}

} // namespace sheet
