// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/sinking_back.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>

#include <fmt/format.h>

#include "libsheet/scene/brief.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using formats::Frame;

// The fastest that any hold goes up at a time [m/s].
double rise_of_holds(const Scene& scene, const Vector3& up, double time) {
  double rise = 0;
  for (const scene::Hold& hold : scene.holds)
    if (const auto* translating = std::get_if<scene::Translating>(&hold.motion);
        translating != nullptr && !translating->velocity.entries.empty())
      rise = std::max(rise, scene::value_at(translating->velocity, time).dot(up));
  return rise;
}

// How far the sheet stands above that inlet, along the way `up` [m], which enters at `speed` of which `rising` is up.
struct Inlet {
  double height = 0, rising = 0;
};
Inlet inlet_of(const Scene& scene, const Frame& first, std::size_t number, const Vector3& up) {
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, scene.inflows[number]);
  const auto x = positions(first);
  const auto bits = masks(first, "inlet");
  double count = 0, lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Inlet inlet;
  for (std::size_t v = 0; v < bits.size(); ++v) {
    highest = std::max(highest, x[v].dot(up));
    if ((of_inlet(bits[v], number) & at_inlet_border) == 0)
      continue;
    lowest = std::min(lowest, x[v].dot(up));
    inlet.rising += velocity.at(first.time, x[v]).dot(up);
    ++count;
  }
  return count > 0 ? Inlet{.height = highest - lowest, .rising = inlet.rising / count} : Inlet{};
}

} // namespace

std::string sinking_back_warning(const Scene& scene, const Frame& first, double until) {
  const auto up = scene::up(scene.environment);
  if (!up || scene.environment.bath || scene.environment.pressure || !scene.solids.empty() || scene.sheets.size() != 1)
    return "";
  const Liquid& liquid = scene::material_of(scene, scene.sheets.front());
  const double weight = liquid.density * scene.environment.gravity->norm();
  if (!(weight > 0) || !liquid.viscous() || !liquid.law.newtonian() || scene.heat)
    return "";
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const scene::Inflow& inflow = scene.inflows[i];
    const Inlet inlet = inlet_of(scene, first, i, *up);
    const double holds_rise = rise_of_holds(scene, *up, first.time);
    if (!(inlet.rising > 0) || !(holds_rise > 0))
      continue;
    const double by_tension = 2 * liquid.surface_tension / (weight * inflow.thickness);
    const double by_viscosity = std::sqrt(8 * liquid.viscosity * std::max(0.0, holds_rise - inlet.rising) / weight);
    const double height = inlet.height + holds_rise * std::min(until, inflow.until.value_or(until));
    const double carried = std::max(by_tension, by_viscosity);
    if (height > carried)
      return fmt::format(
          "what inflow {} brings up sinks back through it by its weight as soon as it stands higher than "
          "{} m, and it is drawn up to {} m: tension carries 2 gamma/(rho g h), and viscosity (8 mu V/"
          "(rho g))^(1/2), V the speed of what draws less that of the inflow. thickness = {} in [inflow] "
          "is light enough for tension",
          i, scene::brief(carried), scene::brief(height), scene::brief(2 * liquid.surface_tension / (weight * height)));
  }
  return "";
}

} // namespace sheet
