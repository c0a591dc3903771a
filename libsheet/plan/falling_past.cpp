// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/falling_past.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/hanging.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/parting.h"
#include "libsheet/plan/way_of_sheet.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/motion.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

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

// Whether any of it lies on a solid from the start, as paint on an upright wall, as thick as it is there.
bool lies_on_solid(const Scene& scene, const Frame& first) {
  constexpr double near_enough = 0.75; // thicknesses
  const solid::Solids solids(scene);
  const auto x = positions(first);
  const auto corners = triangles(first);
  const std::vector<double> thickness = thickness_around(first.vertices, corners, volumes(first), [&](std::uint32_t t) {
    return TriangleArea(x[corners[t][0]], x[corners[t][1]], x[corners[t][2]]).area;
  });
  return std::ranges::any_of(probes_of(first), [&](std::size_t v) {
    for (std::size_t i = 0; i < solids.size(); ++i)
      if (solids.at(i, x[v], first.time).distance < near_enough * thickness[v])
        return true;
    return false;
  });
}

// In which a roll draws on for ever, a unit vector; nothing of other holds.
std::optional<Vector3d> way_of_roll(const scene::Hold& hold, double start) {
  const auto* translating = std::get_if<scene::Translating>(&hold.motion);
  if (!hold.roll || hold.until || translating == nullptr || translating->velocity.entries.empty())
    return std::nullopt;
  const Vector3d velocity =
      scene::value_at(translating->velocity, std::max(start, translating->velocity.entries.back().time));
  return velocity.isZero(0) ? std::nullopt : std::optional<Vector3d>(velocity.normalized());
}

// Where the region of a hold ends in a direction, behind what it holds at the start; nothing if it holds nothing.
std::optional<Vector3d> end_of_hold(const Scene& scene, const Frame& first, std::size_t hold,
                                    const Vector3d& direction) {
  const auto held = holds(first);
  std::optional<Vector3d> last;
  for (std::size_t v = 0; v < held.size(); ++v)
    if (const Vector3d& x = positions(first)[v];
        (held[v] >> hold & 1) != 0 && (!last || x.dot(direction) > last->dot(direction)))
      last = x;
  if (const auto* box = std::get_if<scene::BoxRegion>(&scene.holds[hold].region); box != nullptr && last) {
    const double end = direction.cwiseMax(0).dot(box->high) + direction.cwiseMin(0).dot(box->low);
    *last += std::max(0.0, end - last->dot(direction)) * direction;
  }
  return last;
}

// What comes off a solid before `until`, or hangs over its edge from the start and is drawn out by then; "" if nothing.
std::string why_it_comes_off(const Scene& scene, const Frame& first, double until) {
  Scene parting = scene;
  if (parting.contact)
    parting.contact->adhesion.reset();
  if (const auto comes_off = must_part(parting, first, until))
    return comes_off->thrown ? "" : comes_off->why;
  const Scene cold = scene::as_it_starts(scene);
  const auto hangs = overhang(cold, first, landings(cold, first));
  if (!hangs || !(hangs->time + std::sqrt(2 * hangs->length / scene.environment.gravity->norm()) < until))
    return "";
  return fmt::format("the sheet starts {:.2g} m over the edge of {}: its weight draws out what hangs there, to any "
                     "length, within about {:.2g} s",
                     hangs->length, solid::Solids(scene).name(hangs->solid), hangs->time);
}

} // namespace

std::string falling_past_warning(const Scene& scene, const Frame& first) {
  const Vector3d gravity = scene.environment.gravity.value_or(Vector3d::Zero());
  // Where there are none, that is told of without the frame (explain.h).
  if (scene::nothing_resists_fall(scene) && !scene.solids.empty() && first.vertices > 0 && !lies_on_solid(scene, first))
    return "creeping flow under gravity of a sheet that touches no solid at its start: nothing resists the fall, there "
           "is no solution; let it start on a solid, or with inertia (model.inertia = true)";
  const auto rests = [](const scene::Solid& solid) { return std::holds_alternative<scene::Fixed>(solid.motion); };
  if (scene.solids.empty() || gravity.isZero(0) || !std::ranges::all_of(scene.solids, rests) ||
      !falls_straight_down(scene, first, gravity.normalized()) || !landings(scene, first).empty() ||
      lies_on_solid(scene, first))
    return "";
  return fmt::format("the sheet falls for ever, past every solid: none is below it, where gravity = [{}, {}, {}] pulls",
                     scene::brief(gravity[0]), scene::brief(gravity[1]), scene::brief(gravity[2]));
}

std::string falling_on_warning(const Scene& scene, const Frame& first, double until) {
  if (scene.solids.empty() || !scene::is_bottomless(scene) || first.vertices == 0)
    return "";
  const std::string why = why_it_comes_off(scene, first, until);
  if (why.empty())
    return "";
  const Vector3d up = *scene::up(scene.environment);
  const solid::Solids solids(scene);
  solid::Box3 all = way_of_sheet(first, Vector3d::Zero());
  double highest_low = -std::numeric_limits<double>::infinity(), lowest_high = -highest_low; // of the solids' boxes [m]
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const solid::Box3 box(solids.shape(i).bounds().transformed(solids.pose(i, first.time)));
    const double middle = up.dot(box.center()), half = up.cwiseAbs().dot(box.sizes()) / 2;
    highest_low = std::max(highest_low, middle - half);
    lowest_high = std::min(lowest_high, middle + half);
    all.extend(box);
  }
  if (lowest_high <= highest_low) // one may take up what comes off another one
    return "";
  const double below = all.sizes().dot(up.cwiseAbs()) / 2 + measured(first).length.value_or(0);
  const Vector3d point = all.center() - below * up;
  return fmt::format("{}. Nothing is below: what falls there falls for ever, in steps of its fall. [[outflow]] point = "
                     "[{}, {}, {}], normal = [{}, {}, {}] ends it",
                     why, scene::brief(point.x()), scene::brief(point.y()), scene::brief(point.z()),
                     scene::brief(-up.x()), scene::brief(-up.y()), scene::brief(-up.z()));
}

std::string falling_behind_rolls_warning(const Scene& scene, const Frame& first) {
  constexpr double near_enough = 3; // edges behind the roll
  const Vector3d gravity = scene.environment.gravity.value_or(Vector3d::Zero());
  if (gravity.isZero(0) || scene.environment.bath)
    return "";
  const solid::Solids solids(scene);
  const double edge = scene::mean_edge(first);
  for (std::size_t i = 0; i < scene.holds.size(); ++i) {
    const auto ahead = way_of_roll(scene.holds[i], first.time);
    const auto last = ahead ? end_of_hold(scene, first, i, *ahead) : std::nullopt;
    if (!last)
      continue;
    const Vector3d behind = *last + edge * *ahead;
    const auto takes_up = [&](const scene::Outflow& outflow) {
      return outflow.normal.dot(gravity) > 0 ||
             (outflow.normal.dot(*ahead) > 0 && outflow.normal.dot(outflow.point - *last) < near_enough * edge);
    };
    if (std::ranges::none_of(scene.outflows, takes_up) &&
        !landing_below(solids, gravity.normalized(), behind, measured(first).length.value_or(0), first.time))
      return fmt::format("hold {}, a roll, lets go of what it draws where nothing is below: that falls for ever, in "
                         "steps of its fall. [[outflow]] point = [{}, {}, {}], normal = [{}, {}, {}] ends it there",
                         i, scene::brief(behind.x()), scene::brief(behind.y()), scene::brief(behind.z()),
                         scene::brief(ahead->x()), scene::brief(ahead->y()), scene::brief(ahead->z()));
  }
  return "";
}

} // namespace sheet
