// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/corners.h"

#include <algorithm>

#include "libsheet/base/each.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::solid {
namespace {

// Whether what flows down a wall goes on along another one that stands in its way, of these unit normals: one that
// bears more of its weight, at an angle. In a groove both bear the same.
bool leads_on(const Vector3& wall, const Vector3& floor, const Vector3& gravity) {
  constexpr double flattest = 0.9, same_load = 0.9;
  const double angle = wall.dot(floor), load = -gravity.dot(floor);
  return angle < flattest && angle > -least_facing && load > 0 && same_load * load > -gravity.dot(wall);
}

// Of each vertex, whether it shares a triangle with one that flows along another solid.
std::vector<char> passing(const SheetOnSolids& sheet) {
  std::vector<char> passes(sheet.rides.size(), 0);
  const auto other = [&](std::uint32_t v, std::uint32_t w) {
    return sheet.rides[v] != no_solid && sheet.rides[w] != no_solid && sheet.rides[w] != sheet.rides[v];
  };
  for (const Corners& c : sheet.triangles)
    for (const std::uint32_t v : c)
      if (std::ranges::any_of(c, [&](std::uint32_t w) { return other(v, w); }))
        passes[v] = 1;
  return passes;
}

std::int32_t turned_to(const Solids& solids, const SheetOnSolids& sheet, std::size_t v, bool passes) {
  const auto own = static_cast<std::size_t>(sheet.rides[v]);
  const Vector3& x = sheet.x[v];
  const SolidPoint wall = solids.at(own, x, sheet.t);
  const double reach = wall.distance + 2 * std::max(sheet.thickness[v], sheet.longest_edges[v]);
  for (std::size_t other = 0; other < solids.size(); ++other) {
    if (other == own || solids.scene(other).contact == SolidContact::stick ||
        solids.shape(other).distance(solids.pose(other, sheet.t).inverse() * x, reach) >= reach)
      continue;
    const SolidPoint floor = solids.at(other, x, sheet.t);
    const bool rests = (floor.velocity - wall.velocity).norm() <= 1e-9 * wall.velocity.norm();
    if (rests && (leads_on(wall.normal, floor.normal, sheet.gravity) ||
                  (passes && leads_on(floor.normal, wall.normal, sheet.gravity))))
      return static_cast<std::int32_t>(other);
  }
  return no_solid;
}

} // namespace

std::vector<std::int32_t> turned_to(const Solids& solids, const SheetOnSolids& sheet) {
  std::vector<std::int32_t> others(sheet.rides.size(), no_solid);
  if (solids.size() < 2 || sheet.gravity.isZero(0))
    return others;
  const std::vector<char> passes = passing(sheet);
  each_in_parallel(others.size(), [&](std::size_t v) {
    if (sheet.rides[v] != no_solid)
      others[v] = turned_to(solids, sheet, v, passes[v] != 0);
  });
  return others;
}

} // namespace sheet::solid
