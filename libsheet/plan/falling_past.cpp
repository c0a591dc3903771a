// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/falling_past.h"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "libsheet/plan/landing.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using formats::Frame;

bool is_along(const Vector3d& velocity, const Vector3d& down) {
  constexpr double rounding = 1e-9;
  return velocity.cross(down).norm() <= rounding * velocity.norm();
}

bool flows_in_along(const Scene& scene, const scene::Inflow& inflow, const Vector3d& down) {
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, inflow);
  return !velocity.fans_out() &&
         std::ranges::all_of(velocity.common.entries, [&](const auto& entry) { return is_along(entry.value, down); });
}

bool falls_straight_down(const Scene& scene, const Frame& first, const Vector3d& down) {
  const scene::Environment& around = scene.environment;
  const bool moves = first.find("velocity") != nullptr;
  return scene.holds.empty() && !around.pressure && !around.bath &&
         !(around.air && !around.air->wind.entries.empty()) &&
         std::ranges::none_of(scene.sheets, [](const scene::SheetTable& sheet) { return sheet.enters.has_value(); }) &&
         std::ranges::all_of(scene.inflows,
                             [&](const scene::Inflow& inflow) { return flows_in_along(scene, inflow, down); }) &&
         (!moves || std::ranges::all_of(velocities(first), [&](const Vector3d& v) { return is_along(v, down); }));
}

} // namespace

std::string falling_past_warning(const Scene& scene, const Frame& first) {
  const Vector3d gravity = scene.environment.gravity.value_or(Vector3d::Zero());
  const auto rests = [](const scene::Solid& solid) { return std::holds_alternative<scene::Fixed>(solid.motion); };
  if (scene.solids.empty() || gravity.isZero(0) || !std::ranges::all_of(scene.solids, rests) ||
      !falls_straight_down(scene, first, gravity.normalized()) || !landings(scene, first).empty())
    return "";
  return fmt::format("the sheet falls for ever, past every solid: none is below it, where gravity = [{}, {}, {}] pulls",
                     scene::brief(gravity[0]), scene::brief(gravity[1]), scene::brief(gravity[2]));
}

} // namespace sheet
