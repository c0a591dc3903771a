// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/parting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/over_edge.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/scene/motion.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using Eigen::Vector3d;

// Of a solid's point that is at x when something lands there, at time t: how far above it gets at most, until the end,
// what flies freely from some time on [m].
double height_of_throw(const scene::Motion& motion, const Vector3d& x, double t, double until,
                       const Vector3d& gravity) {
  constexpr std::size_t times = 400;
  if (std::holds_alternative<scene::Fixed>(motion) || !(until > t))
    return 0;
  const double g = gravity.norm(), step = (until - t) / times;
  std::vector<double> height; // of the point, along gravity
  for (std::size_t i = 0; i <= times; ++i)
    height.push_back(-(scene::motion_between(motion, t, t + static_cast<double>(i) * step) * x - x).dot(gravity) / g);
  double highest = 0;
  for (std::size_t i = 1; i < times; ++i)
    for (std::size_t j = i + 1; j <= times; ++j) {
      const double flight = static_cast<double>(j - i) * step, speed = (height[i] - height[i - 1]) / step;
      highest = std::max(highest, height[i] + speed * flight - g * flight * flight / 2 - height[j]);
    }
  return highest;
}

// How long a belt needs to carry what lies at x past its solid's end [s].
double time_to_end(const solid::Solids& solids, std::size_t number, const Vector3d& x, const Vector3d& normal,
                   double t) {
  constexpr double none = 1e-6; // part of the belt's velocity: round-off of that across its face
  const Eigen::Isometry3d to_own = solids.pose(number, t).inverse();
  const Vector3d place = to_own * x, velocity = to_own.linear() * solids.belt_velocity(number, normal);
  const solid::Box3 box = solids.shape(number).bounds();
  double time = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    if (std::abs(velocity[i]) > none * velocity.norm())
      time = std::min(time, ((velocity[i] > 0 ? box.max()[i] : box.min()[i]) - place[i]) / velocity[i]);
  return std::max(time, 0.0);
}

// Whether an outflow takes up what goes on from x at that velocity within a time [s].
bool is_taken_up(const Scene& scene, const Vector3d& x, const Vector3d& velocity, double within) {
  return std::ranges::any_of(scene.outflows, [&](const scene::Outflow& outflow) {
    const double speed = velocity.dot(outflow.normal);
    return speed > 0 && outflow.normal.dot(outflow.point - x) < within * speed;
  });
}

// When what lands at time t on a face of that normal has been turned under the solid; infinity if not before `until`
// [s].
double time_turned_under(const scene::Motion& motion, const Vector3d& normal, double t, double until,
                         const Vector3d& down) {
  constexpr int times = 400;
  constexpr double looks_down = 0.2; // cosine
  if (!scene::turns(motion))
    return std::numeric_limits<double>::infinity();
  for (int i = 0; i <= times; ++i) {
    const double later = t + (until - t) * i / times;
    if ((scene::motion_between(motion, t, later).linear() * normal).dot(down) > looks_down)
      return later;
  }
  return std::numeric_limits<double>::infinity();
}

// Whether a layer so thick hangs by its surface tension.
bool can_hang(const Liquid& liquid, double thickness, double g) {
  return thickness < 2 * std::sqrt(liquid.surface_tension / (liquid.density * g));
}

// Whether a solid that turns on for ever carries such a layer round with it, before it can gather and fall: it does so
// to a mean thickness of 0.705 (nu U/g)^½ on a roll, or in a drum [Moffatt 1977], U the speed of its surface there. A
// layer of that thickness would run down a wall at U/6.
bool is_carried_round(const scene::Motion& motion, const Landing& landing, double thickness, double g, double until) {
  constexpr double part = 1. / 6;
  const auto* turning = std::get_if<scene::Rotating>(&motion);
  if (turning == nullptr || turning->rate.entries.empty() || !(landing.liquid.viscosity > 0))
    return false;
  const Vector3d arm = landing.place - turning->center;
  const double speed = std::abs(scene::value_at(turning->rate, until)) * turning->axis.normalized().cross(arm).norm();
  const double down = scene::speed_of_layer(landing.liquid, landing.liquid.density * g * thickness, thickness, 0);
  return down < part * speed;
}

// Whether all of the sheet lands on one solid, or starts on it: under it, as what is wrapped round a roll.
bool all_lies_on(const solid::Solids& solids, std::size_t number, const formats::Frame& first,
                 const std::vector<Landing>& landings, double thickness) {
  constexpr double near = 0.75; // thicknesses, of what starts on it
  auto landing = landings.begin();
  return std::ranges::all_of(probes_of(first), [&](std::size_t v) {
    if (landing != landings.end() && landing->vertex == v)
      return (landing++)->solid == number;
    return solids.at(number, positions(first)[v], first.time).distance < near * thickness;
  });
}

// As it starts, or else when it has become warm.
std::optional<OverEdge> over_edge(const Scene& with_heat, const formats::Frame& first, double until) {
  const Scene cold = scene::as_it_starts(with_heat);
  const auto edge = goes_over_edge(cold, first, landings(cold, first), first.time, until);
  const auto warming = scene::warming_of(with_heat, *measured(first).thickness);
  return edge || !warming ? edge
                          : goes_over_edge(warming->warm, first, landings(warming->warm, first), warming->time, until);
}

} // namespace

std::optional<Parting> must_part(const Scene& scene, const formats::Frame& first, double until) {
  if (!scene.environment.gravity || (scene.contact && scene.contact->adhesion))
    return std::nullopt;
  const Vector3d& gravity = *scene.environment.gravity;
  const solid::Solids solids(scene);
  const double thickness = *measured(first).thickness;
  const auto parting = [&](const std::string& why, double density, bool thrown) {
    return Parting{why, density * gravity.norm() * thickness / 2, thrown};
  };
  struct Turned {
    std::size_t solid;
    double time, density;
  };
  std::optional<Turned> turned; // under its solid, the first
  std::vector<bool> seen(solids.size(), false);
  std::vector<double> ends(solids.size(), std::numeric_limits<double>::infinity()), densities(solids.size(), 0);
  const std::vector<Landing> all = landings(scene, first);
  const auto lies_wholly_on = [&](std::size_t number) {
    return scene.holds.empty() && scene.inflows.empty() && all_lies_on(solids, number, first, all, thickness);
  };
  for (const Landing& landing : all) {
    const std::size_t number = landing.solid;
    const double t = first.time + std::sqrt(2 * std::max(0.0, landing.fall - thickness / 2) / gravity.norm());
    const double way = time_to_end(solids, number, landing.place, landing.there.normal, first.time), end = t + way;
    if (end < ends[number] &&
        !is_taken_up(scene, landing.place, solids.belt_velocity(number, landing.there.normal), way)) {
      ends[number] = end;
      densities[number] = landing.liquid.density;
    }
    if (seen[number])
      continue;
    seen[number] = true;
    if (const double thrown = height_of_throw(solids.scene(number).motion, landing.place, t, until, gravity);
        thrown > thickness)
      return parting(fmt::format("{} throws what lies on it {:.2g} m up", solids.name(number), thrown),
                     landing.liquid.density, true);
    const double under =
        time_turned_under(solids.scene(number).motion, landing.there.normal, t, until, gravity.normalized());
    const bool stays =
        lies_wholly_on(number) &&
        (can_hang(landing.liquid, thickness, gravity.norm()) ||
         (!scene.heat && is_carried_round(solids.scene(number).motion, landing, thickness, gravity.norm(), until)));
    if (under < (turned ? turned->time : until) && !stays)
      turned = Turned{number, under, landing.liquid.density};
  }
  const auto earliest = std::ranges::min_element(ends);
  const double end = earliest == ends.end() ? until : std::min(until, *earliest);
  if (const auto edge = over_edge(scene, first, end))
    return parting(edge->why, edge->density, false);
  if (turned && turned->time < end)
    return parting(fmt::format("{} turns what lies on it under itself, from about {:.2g} s on",
                               solids.name(turned->solid), turned->time),
                   turned->density, false);
  if (!(end < until))
    return std::nullopt;
  const auto number = static_cast<std::size_t>(earliest - ends.begin());
  return parting(
      fmt::format("{} carries what lies on it past its end, from about {:.2g} s on", solids.name(number), *earliest),
      densities[number], false);
}

} // namespace sheet
