// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/corners.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "libsheet/base/each.h"
#include "libsheet/geometry/rounded_corner.h"
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

std::int32_t turned_to(const Solids& solids, const SheetOnSolids& sheet, std::size_t v, bool passes) {
  const auto own = static_cast<std::size_t>(sheet.rides[v]);
  const Vector3& x = sheet.x[v];
  const SolidPoint wall = solids.at(own, x, sheet.t);
  const auto motion_of = [&](std::size_t solid) { return scene::velocity_at(solids.scene(solid).motion, sheet.t, x); };
  const double reach = wall.distance + 2 * std::max(sheet.thickness[v], sheet.longest_edges[v]);
  for (std::size_t other = 0; other < solids.size(); ++other) {
    if (other == own || solids.scene(other).contact == SolidContact::stick ||
        solids.shape(other).distance(solids.pose(other, sheet.t).inverse() * x, reach) >= reach)
      continue;
    const SolidPoint floor = solids.at(other, x, sheet.t);
    const Vector3 motion = motion_of(own), relative = motion_of(other) - motion;
    const bool rests = relative.norm() <= 1e-9 * motion.norm(); // whatever belts run on them
    if (rests && (leads_on(wall.normal, floor.normal, sheet.gravity) ||
                  (passes && leads_on(floor.normal, wall.normal, sheet.gravity))))
      return static_cast<std::int32_t>(other);
  }
  return no_solid;
}

// Of the triangles around each vertex.
std::vector<Vector3> area_vectors(const SheetOnSolids& sheet) {
  std::vector<Vector3> sum(sheet.x.size(), Vector3::Zero());
  for (const auto& [a, b, c] : sheet.triangles) {
    const Vector3 area = (sheet.x[b] - sheet.x[a]).cross(sheet.x[c] - sheet.x[a]);
    for (const std::uint32_t v : {a, b, c})
      sum[v] += area;
  }
  return sum;
}

// Where a vertex is in a corner of its own mesh.
enum class PlaceInCorner : char { nowhere, on_the_floor, on_the_side };

PlaceInCorner part_of_corner(const Solids& solids, const SheetOnSolids& sheet, std::size_t v, const Vector3& area) {
  constexpr double nearly = 0.95;
  const auto own = static_cast<std::size_t>(sheet.rides[v]);
  const auto nearest = [&](const Vector3& x) { return solids.at(own, x, sheet.t); };
  const double height = 2 * std::max(sheet.thickness[v], sheet.longest_edges[v]);
  const SolidPoint wall = nearest(sheet.x[v]);
  const double within = nearly * (wall.distance + height); // cheaper to know
  if (solids.shape(own).distance(solids.pose(own, sheet.t).inverse() * (sheet.x[v] + height * wall.normal), within) >=
      within)
    return PlaceInCorner::nowhere;
  const auto other = face_beside(nearest, sheet.x[v], height);
  if (!other)
    return PlaceInCorner::nowhere;
  const Vector3& face = wall.normal;
  const bool down = leads_on(face, other->normal, sheet.gravity);
  if (!down && !leads_on(other->normal, face, sheet.gravity))
    return PlaceInCorner::nowhere;
  const Vector3 &side = down ? face : other->normal, &floor = down ? other->normal : face;
  return std::abs(area.dot(side)) > std::abs(area.dot(floor)) ? PlaceInCorner::on_the_side
                                                              : PlaceInCorner::on_the_floor;
}

// What turns in corners of single meshes.
void turn_in_meshes(const Solids& solids, const SheetOnSolids& sheet, std::vector<std::int32_t>& others) {
  const auto on_mesh = [&](std::int32_t solid) {
    return solid != no_solid &&
           std::holds_alternative<scene::SolidMesh>(solids.scene(static_cast<std::size_t>(solid)).shape);
  };
  if (std::ranges::none_of(sheet.rides, on_mesh))
    return;
  const std::vector<Vector3> area = area_vectors(sheet);
  std::vector<PlaceInCorner> part(others.size(), PlaceInCorner::nowhere);
  each_in_parallel(others.size(), [&](std::size_t v) {
    if (others[v] == no_solid && on_mesh(sheet.rides[v]))
      part[v] = part_of_corner(solids, sheet, v, area[v]);
  });
  for (const Corners& c : sheet.triangles)
    for (const std::uint32_t v : c)
      if (part[v] != PlaceInCorner::nowhere && std::ranges::any_of(c, [&](std::uint32_t w) {
            return part[w] == PlaceInCorner::on_the_side && sheet.rides[w] == sheet.rides[v];
          }))
        others[v] = sheet.rides[v];
}

} // namespace

std::vector<std::uint8_t> passing(std::span<const Corners> triangles, std::span<const std::int32_t> rides) {
  std::vector<std::uint8_t> passes(rides.size(), 0);
  const auto other = [&](std::uint32_t v, std::uint32_t w) { return rides[w] != no_solid && rides[w] != rides[v]; };
  for (const Corners& c : triangles)
    for (const std::uint32_t v : c)
      if (std::ranges::any_of(c, [&](std::uint32_t w) { return other(v, w); }))
        passes[v] = 1;
  return passes;
}

std::vector<std::int32_t> turned_to(const Solids& solids, const SheetOnSolids& sheet) {
  std::vector<std::int32_t> others(sheet.rides.size(), no_solid);
  if (sheet.gravity.isZero(0))
    return others;
  const std::vector<std::uint8_t> passes = passing(sheet.triangles, sheet.rides);
  each_in_parallel(others.size(), [&](std::size_t v) {
    if (sheet.rides[v] != no_solid && solids.size() > 1)
      others[v] = turned_to(solids, sheet, v, passes[v] != 0);
  });
  turn_in_meshes(solids, sheet, others);
  return others;
}

} // namespace sheet::solid
