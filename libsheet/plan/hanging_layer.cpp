// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging_layer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "libsheet/material/flow_curve.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/motion.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

struct Hanging {
  std::size_t vertex, solid;
  double pull; // gravity's part away from the solid [m/s²]
};

// Below which solid that vertex hangs.
std::optional<Hanging> hangs(const Scene& scene, const solid::Solids& solids, const formats::Frame& first,
                             std::size_t vertex, double thickness) {
  constexpr double near = 0.75, looks_down = 0.5; // thicknesses; cosine
  const Vector3& gravity = *scene.environment.gravity;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const scene::Solid& solid = scene.solids[i];
    if (solid.contact == SolidContact::stick || scene::turns(solid.motion))
      continue;
    const solid::SolidPoint point = solids.at(i, positions(first)[vertex], first.time);
    const double pull = point.normal.dot(gravity);
    if (std::abs(point.distance) < near * thickness && pull > looks_down * gravity.norm())
      return Hanging{vertex, i, pull};
  }
  return std::nullopt;
}

} // namespace

std::string hanging_layer_warning(const Scene& scene, const formats::Frame& first, double until) {
  constexpr double least_part = 0.1, late = 5; // of the probes; times the run
  if (!scene::up(scene.environment) || scene.solids.empty() || first.vertices == 0)
    return {};
  const scene::Measured sheet = measured(first);
  const double h = *sheet.thickness;
  const solid::Solids solids(scene);
  const std::vector<std::size_t> probes = probes_of(first);
  std::vector<Hanging> all;
  for (const std::size_t v : probes)
    if (const auto hanging = hangs(scene, solids, first, v, h))
      all.push_back(*hanging);
  if (static_cast<double>(all.size()) < least_part * static_cast<double>(probes.size()))
    return {};
  const Hanging& most = *std::ranges::max_element(all, {}, &Hanging::pull);
  const scene::FrameLiquids liquids(scene, first);
  const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(first);
  const Liquid& liquid = liquids.all()[numbers.empty() ? 0 : numbers[most.vertex]];
  const double weight = liquid.density * most.pull, at_rest = viscosity_of(liquid, {0});
  const double apart = 2 * std::numbers::pi * std::sqrt(2 * liquid.surface_tension / weight);
  const double growth =
      std::max(12 * at_rest * liquid.surface_tension / (weight * weight * h * h * h), 3 * at_rest / (weight * h));
  if (!(growth < late * until) || apart > sheet.length.value_or(0))
    return {};
  return fmt::format(
      "the sheet hangs below {}: its weight would gather it to drops, {}which grow by e within {} s, but "
      "a layer below a solid feels none of that here, and stays as it is",
      solids.name(most.solid), apart > 0 ? fmt::format("{} m apart, ", scene::brief(apart)) : "", scene::brief(growth));
}

} // namespace sheet
