// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/inflow_warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "libsheet/flow/inlet.h"
#include "libsheet/geometry/area.h"
#include "libsheet/plan/inlet_width.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/sheet_edges.h"

namespace sheet {

namespace {

using formats::Frame;

// Of the inflow's velocity at the inlet, in the mean: its part across the sheet, and upward.
struct Part {
  double across = 0, upward = 0;
};

Part part_of(const Frame& first, const scene::InletVelocity& velocity, std::size_t number, const Vector3& up) {
  const auto x = positions(first);
  Part sum;
  double count = 0;
  for (const flow::InletChain& chain : flow::find_inlet(first, number))
    for (std::size_t i = 0; i < chain.edges(); ++i, ++count) {
      const Corners& c = triangles(first)[chain.behind[i]];
      const Vector3 v =
          velocity.at(first.time, (x[chain.border[i]] + x[chain.border[chain.after(i)]]) / 2).normalized();
      sum.across += std::abs(v.dot(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).normal.normalized()));
      sum.upward += v.dot(up);
    }
  return count > 0 ? Part{sum.across / count, sum.upward / count} : Part{};
}

// Of what a belt draws out where it lands. The way on which it does is about as long as the fall, or as the layer is
// thick: if edges are much longer, each row of them is drawn by itself, by turns more and less.
std::string warning_of_ribs(const Scene& scene, const Frame& first, std::size_t number) {
  constexpr double drawn = 1.2, longer = 1.5; // times its speed; times that way
  const auto landing = landing_of_inflow(scene, first, number);
  if (!landing)
    return {};
  const double entering = scene::inlet_velocity(scene, scene.inflows[number]).speed(first.time);
  const double speed = speed_after_fall(scene, entering, *landing), belt = landing->there.velocity.norm();
  const double thickness = scene.inflows[number].thickness, edge = scene::mean_edge(first);
  const double way = std::max(landing->fall - thickness / 2, thickness);
  if (!(belt > drawn * speed) || edge < longer * way)
    return {};
  return fmt::format(
      "inflow {} is drawn by {} from {:.2g} to {:.2g} m/s on a way of some {:.2g} m, and edges are {:.2g} "
      "m long: it comes out in ribs, by turns thick and thin. edge_length = {:.2g} in [sheet] draws it "
      "evenly",
      number, solid::Solids(scene).name(landing->solid), speed, belt, way, edge, way);
}

} // namespace

std::vector<std::string> inflow_warnings(const Scene& scene, const Frame& first) {
  constexpr double most = 0.87; // sine of 60 degrees
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (const double width = width_of_inlet(first, i), thickness = scene.inflows[i].thickness;
        width > 0 && thickness > width)
      warnings.push_back(fmt::format(
          "inflow {} is thicker ({} m) than wide ({} m): it is no sheet; if {} mm are meant, "
          "thickness = \"{} mm\", as plain numbers are metres",
          i, scene::brief(thickness), scene::brief(width), scene::brief(thickness), scene::brief(thickness)));
  const auto up = scene::up(scene.environment);
  for (std::size_t i = 0; i < scene.inflows.size() && up; ++i) {
    const scene::InletVelocity velocity = scene::inlet_velocity(scene, scene.inflows[i]);
    const Part part = velocity.speed(first.time) > 0 ? part_of(first, velocity, i, *up) : Part{};
    if (part.across > most && part.upward > most)
      warnings.push_back(fmt::format("inflow {} goes up out of the sheet, across it, and comes down on it: what flows "
                                     "in has its velocity along the sheet, away from the border where it enters; "
                                     "radial_velocity is along a disk",
                                     i));
  }
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (const std::string ribs = warning_of_ribs(scene, first, i); !ribs.empty())
      warnings.push_back(ribs);
  return warnings;
}

} // namespace sheet
