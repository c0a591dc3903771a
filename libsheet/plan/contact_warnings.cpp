// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/contact_warnings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>

#include "libsheet/material/flow_curve.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/piling.h"
#include "libsheet/plan/sheets_meet.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using formats::Frame;

constexpr double far_down = 3, far_spread = 5; // thicknesses

std::string question(const std::string& solid, const std::string& otherwise) {
  return fmt::format("does liquid stay where it touches {}? contact = \"stick\" holds it there, though {}: contact = "
                     "\"flow\" lets it",
                     solid, otherwise);
}

// Of an inflow that lands on a solid at rest, to which it sticks; else "".
std::string warning_of_stuck_inflow(const Scene& scene, const solid::Solids& solids, const Frame& first,
                                    std::size_t number, double until) {
  const auto landing = landing_of_inflow(scene, first, number);
  if (!landing || scene.solids[landing->solid].contact != SolidContact::stick || landing->there.velocity.norm() > 0)
    return {};
  const scene::Inflow& inflow = scene.inflows[number];
  const Liquid& liquid = scene::material_of(scene, sheet_named(scene, inflow.sheet));
  const double speed = scene::inlet_velocity(scene, inflow).speed(first.time), density = liquid.density;
  const double q = inflow.thickness * speed, rate = speed / inflow.thickness;
  const double viscosity = viscosity_of(liquid, {rate * rate});
  const double spread =
      std::pow(density * scene.environment.gravity->norm() * q * q * q / (3 * viscosity), 0.2) * std::pow(until, 0.8);
  if (!(spread > far_spread * inflow.thickness))
    return {};
  return question(solids.name(landing->solid),
                  fmt::format("what flows in would spread on it by about {:.1g} m within {:.3g} s", spread, until));
}

// Of the sheet, where it lies on or falls on an inclined solid, to which it sticks; else "".
std::string warning_of_stuck_slope(const Scene& scene, const solid::Solids& solids, std::size_t number,
                                   const std::vector<Landing>& all, double thickness, double until) {
  if (scene.solids[number].contact != SolidContact::stick)
    return {};
  const Vector3d down = scene.environment.gravity.value_or(Vector3d::Zero()).normalized();
  double slope = 0;
  Liquid liquid; // of the first that lands there
  for (const Landing& landing : all)
    if (landing.solid == number) {
      if (slope == 0)
        liquid = landing.liquid;
      slope += landing.there.normal.cross(down).norm() / static_cast<double>(all.size());
    }
  const double stress = slope > 0 ? liquid.density * scene.environment.gravity->norm() * slope * thickness : 0;
  const double way = slope > 0 ? scene::speed_of_layer(liquid, stress, thickness, 0) * until : 0;
  if (!(way > far_down * thickness))
    return {};
  return question(solids.name(number),
                  fmt::format("down its slope a layer as thick as the sheet would run about {:.1g} "
                              "m within {:.3g} s",
                              way, until));
}

// Of what lies on a solid to which it sticks, where another one passes so low over it that it would push it ahead; else
// "".
std::string warning_of_stuck_spreading(const Scene& scene, const solid::Solids& solids, std::size_t number,
                                       const std::vector<Landing>& all, double thickness, double start, double until) {
  constexpr int times = 100;
  if (scene.solids[number].contact != SolidContact::stick || !solids.may_squeeze())
    return {};
  const auto passes = [&](const Landing& landing, double t) -> std::optional<solid::Solids::Facing> {
    const Vector3d place = scene::motion_between(scene.solids[number].motion, start, t) * landing.place;
    const auto facing = solids.facing(number, place, t, thickness);
    if (!facing)
      return std::nullopt;
    const solid::SolidPoint own = solids.at(number, place, t);
    const auto goes_along = [&](const Vector3d& velocity) {
      const Vector3d past = velocity - own.velocity;
      return std::abs(past.dot(own.normal)) < past.cross(own.normal).norm();
    };
    const Vector3d middle = solids.pose(facing->solid, t).translation(); // of what rolls: that is what moves on
    const bool along = goes_along(solids.surface_velocity(facing->solid, place, -own.normal, t)) ||
                       goes_along(scene::velocity_at(scene.solids[facing->solid].motion, t, middle));
    return along ? facing : std::nullopt;
  };
  for (int k = 0; k <= times; ++k)
    for (const Landing& landing : all)
      if (landing.solid == number && landing.fall < thickness)
        if (const auto facing = passes(landing, start + (until - start) * k / times))
          return question(solids.name(number),
                          fmt::format("{} passes over it with {:.2g} m to spare, less than the sheet is thick, and "
                                      "would push it ahead",
                                      solids.name(facing->solid), facing->gap));
  return {};
}

// The solid over which a free sheet falls or hangs, so that it falls far onto others.
std::optional<std::size_t> draped(const Scene& scene, const std::vector<Landing>& all, double thickness) {
  if (all.empty() || !scene.holds.empty())
    return std::nullopt;
  const auto [first, last] = std::ranges::minmax_element(all, {}, &Landing::fall);
  return first->solid != last->solid && last->fall > far_down * thickness ? std::optional(first->solid) : std::nullopt;
}

// Of what folds, piles up or comes together, though it may pass through itself; else "".
std::string warning_of_passing_through(const Scene& scene, const solid::Solids& solids, const Frame& first,
                                       const std::vector<Landing>& all, double thickness) {
  if (scene.contact && scene.contact->self)
    return {};
  if (const auto piling = what_piles_up(scene, first, all))
    return fmt::format("{} lands on {} and folds or piles up, but may pass through itself: [contact] self = true "
                       "keeps its layers apart",
                       piling->what, solids.name(piling->solid));
  if (sheets_may_meet(scene, all))
    return "the sheets may pass through each other and themselves: [contact] self = true keeps them apart";
  if (const auto solid = draped(scene, all, thickness))
    return fmt::format(
        "the sheet comes down over {} and beyond, where it may fold and pass through itself: [contact] self "
        "= true keeps its layers apart",
        solids.name(*solid));
  return {};
}

} // namespace

std::vector<std::string> contact_warnings(const Scene& scene, const Frame& first, double until) {
  const solid::Solids solids(scene);
  const std::vector<Landing> all = landings(scene, first);
  const double thickness = *measured(first).thickness;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    warnings.push_back(warning_of_stuck_inflow(scene, solids, first, i, until));
  const bool asked = std::ranges::any_of(warnings, [](const std::string& warning) { return !warning.empty(); });
  for (std::size_t i = 0; i < solids.size() && !asked; ++i) {
    warnings.push_back(warning_of_stuck_slope(scene, solids, i, all, thickness, until));
    if (warnings.back().empty())
      warnings.push_back(warning_of_stuck_spreading(scene, solids, i, all, thickness, first.time, until));
  }
  warnings.push_back(warning_of_passing_through(scene, solids, first, all, thickness));
  std::erase(warnings, "");
  return warnings;
}

} // namespace sheet
