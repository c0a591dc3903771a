// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/inflow_warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "libsheet/flow/inlet.h"
#include "libsheet/geometry/area.h"
#include "libsheet/plan/inlet_width.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/mesh_warnings.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/brief.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/solid/solids.h"

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
      "m long: it comes out in ribs, by turns thick and thin. {} draws it evenly",
      number, solid::Solids(scene).name(landing->solid), speed, belt, way, edge, setting_of_edges(scene, way));
}

// Of a sheet that starts slower than what flows in behind it. With u the difference, the sheet is taken along from the
// inlet on as far as sqrt(D t), D = 4 μ/ρ, while u t flows in, until it moves as a whole, or gravity has made it as
// fast: it is shortened by about u L/D, or u (u/(g D))^(1/2), if that is less. Measured: 1.2 makes a flat sheet 1.5
// times as thick at the inlet; one that is not quite flat folds.
std::string warning_of_start(const Scene& scene, const Frame& first, std::size_t number) {
  constexpr double much = 1;
  const scene::Inflow& inflow = scene.inflows[number];
  const Liquid liquid = sheet_named(scene, inflow.sheet).material.value_or(scene.material);
  if (!scene.model.inertia || !(liquid.viscosity > 0) || !(liquid.density > 0))
    return {};
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, inflow);
  const auto x = positions(first);
  const auto v = velocities(first);
  const auto bits = masks(first, "inlet");
  Vector3 entering = Vector3::Zero(), starting = Vector3::Zero(), middle = Vector3::Zero();
  double edges = 0, corners = 0;
  for (const flow::InletChain& chain : flow::find_inlet(first, number))
    for (std::size_t i = 0; i < chain.edges(); ++i, ++edges) {
      const Vector3 at = (x[chain.border[i]] + x[chain.border[chain.after(i)]]) / 2;
      entering += velocity.at(first.time, at);
      middle += at;
      for (const std::uint32_t c : triangles(first)[chain.behind[i]])
        if (bits[c] == 0) {
          starting += v.empty() ? Vector3(Vector3::Zero()) : v[c];
          ++corners;
        }
    }
  if (corners == 0 || !(entering.norm() > 0) || velocity.fans_out() || scene.sheets.size() > 1)
    return {};
  entering /= edges, middle /= edges, starting /= corners;
  const Vector3 along = entering.normalized();
  const double u = (entering - starting).dot(along), d = 4 * liquid.viscosity / liquid.density,
               g = scene.environment.gravity ? scene.environment.gravity->dot(along) : 0;
  double length = 0;
  for (const Vector3& p : x)
    length = std::max(length, (p - middle).dot(along));
  if (!(u > 0) || !(u * std::min(length / d, g > 0 ? std::sqrt(u / (g * d)) : length / d) > much))
    return {};
  return fmt::format(
      "inflow {} enters at {:.2g} m/s, and the sheet starts at {:.2g} m/s along it: it thickens or folds "
      "at the inlet before it moves as fast. velocity = [{:g}, {:g}, {:g}] in [sheet] lets it start so",
      number, entering.norm(), starting.dot(along), entering.x(), entering.y(), entering.z());
}

// Of what flows in along a bath and is bent at the inlet, as it floats deeper or less deep than that lies.
std::string warning_of_floating(const Scene& scene, const Frame& first, std::size_t number, const Vector3& up) {
  constexpr double steepest = 0.5, most = 0.5, near = 1; // sine of 30 degrees; thicknesses: off, from the level
  const auto& bath = scene.environment.bath;
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, scene.inflows[number]);
  const double h = scene.inflows[number].thickness, speed = velocity.speed(first.time);
  const double density = sheet_named(scene, scene.inflows[number].sheet).material.value_or(scene.material).density;
  if (!bath || !(speed > 0) || !(density < bath->density))
    return {};
  const auto x = positions(first);
  const auto bits = masks(first, "inlet");
  double height = 0, upward = 0, count = 0;
  for (std::size_t v = 0; v < bits.size(); ++v)
    if ((of_inlet(bits[v], number) & at_inlet_border) != 0) {
      height += up.dot(x[v]);
      upward += std::abs(velocity.at(first.time, x[v]).normalized().dot(up));
      ++count;
    }
  if (count == 0 || upward > steepest * count)
    return {};
  const double off = height / count - bath->level, floats = -density / bath->density * h;
  if (std::abs(off) > near * h || std::abs(off - floats) < most * h)
    return {};
  return fmt::format(
      "inflow {} comes in {:.3g} m {} the bath's level, and its middle floats {:.3g} m under that (rho h "
      "/ rho_bath): it bends down at the inlet at once. A center of the sheet that is {:.3g} m lower lets "
      "it float",
      number, std::abs(off), off < 0 ? "under" : "above", -floats, off - floats);
}

// Of what flows in along a solid, but so far from it that it does not lie on that, and brings more than its weight and
// the solid carry off: it bends down at the inlet, and folds there.
std::string warning_of_hovering(const Scene& scene, const Frame& first, std::size_t number, const Vector3& up) {
  constexpr double steepest = 0.5, flattest = 0.3; // parts of a direction along the solid's normal
  constexpr double nearest = 0.75, farthest = 1.5; // thicknesses; what is farther is poured on it
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, scene.inflows[number]);
  const double h = scene.inflows[number].thickness, speed = velocity.speed(first.time);
  const Liquid& liquid = scene::material_of(scene, sheet_named(scene, scene.inflows[number].sheet));
  const solid::Solids solids(scene);
  const auto x = positions(first);
  const auto bits = masks(first, "inlet");
  for (std::size_t s = 0; s < solids.size() && speed > 0; ++s) {
    double height = 0, across = 0, carried = 0, count = 0;
    Vector3 normal = Vector3::Zero();
    for (std::size_t v = 0; v < bits.size(); ++v)
      if ((of_inlet(bits[v], number) & at_inlet_border) != 0) {
        const solid::SolidPoint there = solids.at(s, x[v], first.time);
        const Vector3 along = velocity.at(first.time, x[v]).normalized();
        height += there.distance;
        across += std::abs(along.dot(there.normal));
        carried += along.dot(there.velocity);
        normal += there.normal;
        ++count;
      }
    if (count == 0 || across > steepest * count || up.dot(normal) < flattest * count || height < nearest * h * count ||
        height > farthest * h * count)
      continue;
    const double slope = up.cross(normal.normalized()).norm();
    const double stress = liquid.density * scene.environment.gravity->norm() * slope * h;
    if (speed > scene::speed_of_layer(liquid, stress, h, 0) + carried / count)
      return fmt::format("inflow {} comes in {:.3g} m from {}, along it, and the middle of what lies there is half a "
                         "thickness, {:.3g} m, from it: it bends down at the inlet, and folds there, as it brings more "
                         "than runs away. A center of the sheet that is {:.3g} m nearer lets it lie there",
                         number, height / count, solids.name(s), h / 2, height / count - h / 2);
  }
  return {};
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
  for (std::size_t i = 0; i < scene.inflows.size() && up; ++i)
    if (const std::string floating = warning_of_floating(scene, first, i, *up); !floating.empty())
      warnings.push_back(floating);
  for (std::size_t i = 0; i < scene.inflows.size() && up; ++i)
    if (const std::string hovering = warning_of_hovering(scene, first, i, *up); !hovering.empty())
      warnings.push_back(hovering);
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (const std::string start = warning_of_start(scene, first, i); !start.empty())
      warnings.push_back(start);
  return warnings;
}

} // namespace sheet
