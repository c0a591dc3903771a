// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>
#include <vector>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/scales.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

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

// What turns about an upright axis in its place stands, too, as a gob on its pipe.
bool stands_for_ever(const scene::Hold& hold, const Vector3d& up) {
  constexpr double rounding = 1e-9;
  const auto* turning = std::get_if<scene::Rotating>(&hold.motion);
  const bool in_place = std::holds_alternative<scene::Fixed>(hold.motion) ||
                        (turning != nullptr && turning->velocity.entries.empty() &&
                         turning->axis.cross(up).norm() <= rounding * turning->axis.norm());
  return in_place && !hold.until && !hold.roll && hold.axes == all_axes;
}

bool hangs_by_its_weight(const Scene& scene) {
  const scene::Environment& around = scene.environment;
  const auto up = scene::up(around);
  return scene.sheets.size() == 1 && up && scene.material.density > 0 && scene.material.viscous() &&
         (!around.pressure || scene::encloses_gas(scene)) && !around.bath && scene.inflows.empty() &&
         !scene.holds.empty() &&
         std::ranges::all_of(scene.holds, [&](const scene::Hold& hold) { return stands_for_ever(hold, *up); });
}

// Of gas that presses from within, in the wall of a ball whose radius is the sheet's length: p L/(2 h) [Pa].
double stress_of_gas(const Scene& scene, const Frame& first) {
  double stress = 0;
  for (const scene::Scales& scales : scene::scales_of_sheets(scene, measured_sheets(scene, first)))
    if (scales.length && scales.thickness)
      stress = std::max(stress, scales.pressure * *scales.length / (2 * *scales.thickness));
  return stress;
}

// In which heat changes how it flows [s]; without end where it does not.
double heat_time(const Scene& scene, const Frame& first) {
  double least = std::numeric_limits<double>::infinity();
  for (const scene::Scales& scales : scene::scales_of_sheets(scene, measured_sheets(scene, first)))
    for (const scene::Scale& scale : scene::heat_scales(scene, scales))
      least = std::min(least, scale.value);
  return least;
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

// 3 mu/(rho g D) in general; none where tension holds it, or it does not yield.
std::optional<double> time_to_run_away(const Liquid& liquid, double stress, double thickness) {
  if (!(stress > 2 * liquid.surface_tension / thickness) || !(driven_rate(liquid, stress / 3) > 0))
    return {};
  return liquid.law.newtonian() ? 3 * liquid.viscosity / stress : time_under(liquid, stress);
}

// Of the probes those that are neither above a solid nor lie on one.
std::vector<std::size_t> beside_solids(const Scene& scene, const Frame& first, const std::vector<Landing>& all,
                                       double thickness) {
  constexpr double near = 0.75; // thicknesses, of what lies on it
  const solid::Solids solids(scene);
  const auto lies = [&](std::size_t v) {
    for (std::size_t i = 0; i < solids.size(); ++i)
      if (solids.at(i, positions(first)[v], first.time).distance < near * thickness)
        return true;
    return std::ranges::any_of(all, [&](const Landing& landing) { return landing.vertex == v; });
  };
  std::vector<std::size_t> beside = probes_of(first);
  std::erase_if(beside, lies);
  return beside;
}

} // namespace

std::optional<double> runaway_time(const Scene& with_heat, const Frame& first) {
  const Scene scene = scene::as_it_starts(with_heat);
  if (!hangs_by_its_weight(scene) || !landings(scene, first).empty())
    return {};
  const double stress = scene.material.density * scene.environment.gravity->norm() * hanging_length(first);
  if (!(stress > stress_of_gas(scene, first)))
    return {};
  const auto time = time_to_run_away(scene.material, stress, *measured(first).thickness);
  return time && *time < heat_time(scene, first) ? time : std::nullopt;
}

std::optional<Overhang> overhang(const Scene& scene, const Frame& first, const std::vector<Landing>& all) {
  const scene::Environment& around = scene.environment;
  if (all.empty() || !scene.holds.empty() || !scene.inflows.empty() || around.pressure || around.bath)
    return {};
  const auto x = positions(first);
  const double thickness = *measured(first).thickness;
  Overhang farthest{.solid = 0, .length = 0, .time = 0};
  Liquid liquid = all.front().liquid;
  for (const std::size_t v : beside_solids(scene, first, all, thickness)) {
    const auto distance = [&](const Landing& landing) { return (x[landing.vertex] - x[v]).norm(); };
    const auto nearest = std::ranges::min_element(all, {}, distance);
    if (distance(*nearest) > farthest.length) {
      farthest.solid = nearest->solid;
      farthest.length = distance(*nearest);
      liquid = nearest->liquid;
    }
  }
  const double stress = liquid.density * around.gravity->norm() * farthest.length;
  const auto time = time_to_run_away(liquid, stress, thickness);
  if (!time)
    return {};
  farthest.time = *time;
  return farthest;
}

} // namespace sheet
