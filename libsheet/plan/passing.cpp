// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/passing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <variant>

#include "libsheet/geometry/area.h"
#include "libsheet/plan/landing.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using solid::Box3;

// Of the sheet with its thickness, and of where it falls.
Box3 way_of_the_sheet(const Scene& scene, const formats::Frame& first) {
  const auto x = positions(first);
  Box3 box;
  for (std::size_t t = 0; t < first.triangles; ++t) {
    const Corners& c = triangles(first)[t];
    const double half = volumes(first)[t] / TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area / 2;
    for (const std::uint32_t v : c)
      for (const double side : {-half, half})
        box.extend(Vector3((x[v].array() + side).matrix()));
  }
  if (const Vector3 gravity = scene.environment.gravity.value_or(Vector3::Zero());
      gravity.norm() > 0 && !box.isEmpty()) {
    const Vector3 fall = longest_fall(landings(scene, first)) * gravity.normalized();
    box.extend(box.translated(fall));
  }
  return box;
}

// When a box that moves at this velocity from the time 0 on leaves another one; 0 if it does not come through.
double leaves(const Box3& moving, const Vector3& velocity, const Box3& other) {
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double before = other.min()[i] - moving.max()[i], behind = other.max()[i] - moving.min()[i];
    if (velocity[i] == 0) {
      if (before > 0 || behind < 0)
        return 0;
      continue;
    }
    const auto [first, last] = std::minmax({before / velocity[i], behind / velocity[i]});
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  }
  return enters < leaves && leaves < std::numeric_limits<double>::infinity() ? leaves : 0;
}

} // namespace

double passing_time(const Scene& scene, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Box3 way = way_of_the_sheet(scene, first);
  if (way.isEmpty())
    return 0;
  std::array<double, 3> sizes = {way.sizes().x(), way.sizes().y(), way.sizes().z()};
  std::ranges::sort(sizes);
  double passed = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Box3& bounds = solids.shape(i).bounds();
    if (const auto* motion = std::get_if<scene::Translating>(&scene.solids[i].motion);
        motion != nullptr && !motion->velocity.entries.empty() && bounds.sizes().allFinite()) {
      const double start = std::max(first.time, motion->velocity.entries.back().time);
      const Vector3 velocity = scene::value_at(motion->velocity, start);
      const double time = leaves(bounds.transformed(solids.pose(i, start)), velocity, way);
      if (time > 0)
        passed = std::max(passed, start + std::max(time, sizes[1] / velocity.norm()));
    } else if (const auto* turning = std::get_if<scene::Rotating>(&scene.solids[i].motion);
               turning != nullptr && !turning->rate.entries.empty()) {
      const double start = std::max(first.time, turning->rate.entries.back().time);
      if (const double rate = std::abs(scene::value_at(turning->rate, start)); rate > 0)
        passed = std::max(passed, start + 2 * std::numbers::pi / rate);
    }
  }
  return passed;
}

} // namespace sheet
