// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/sheets_meet.h"

#include <algorithm>
#include <variant>

#include "libsheet/plan/way_of_sheet.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using solid::Box3;

bool stands(const scene::Motion& motion) { return std::holds_alternative<scene::Fixed>(motion); }

// By what is prescribed, by what flows in or by what surrounds them.
bool carried(const Scene& scene) {
  const scene::Environment& around = scene.environment;
  return !scene.inflows.empty() || around.pressure || around.bath || around.air ||
         std::ranges::any_of(scene.holds, [](const scene::Hold& hold) { return !stands(hold.motion); }) ||
         std::ranges::any_of(scene.solids, [](const scene::Solid& solid) {
           return !stands(solid.motion) || solid.surface_velocity.norm() > 0;
         });
}

bool moves(const formats::Frame& sheet) {
  return std::ranges::any_of(velocities(sheet), [](const Vector3& u) { return u.norm() > 0; });
}

} // namespace

bool sheets_may_meet(const Scene& scene, const std::vector<Landing>& all) {
  constexpr double level = 0.02; // steeper, what lies there comes down
  if (scene.sheets.size() < 2)
    return false;
  const Vector3 down = scene.environment.gravity.value_or(Vector3::Zero()).normalized();
  if (carried(scene) ||
      std::ranges::any_of(all, [&](const Landing& landing) { return landing.there.normal.cross(down).norm() > level; }))
    return true;
  std::vector<Box3> ways;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i) {
    const formats::Frame sheet = build_sheet(scene, i, Notes::silent);
    const Box3 way = way_of_sheet(sheet, longest_fall(all) * down);
    const double width = middle_size(way);
    if (moves(sheet) || std::ranges::any_of(ways, [&](const Box3& other) {
          return way.exteriorDistance(other) < std::max(width, middle_size(other));
        }))
      return true;
    ways.push_back(way);
  }
  return false;
}

} // namespace sheet
