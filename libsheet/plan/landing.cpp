// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/landing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using formats::Frame;

// The liquids of a frame's vertices.
class VertexLiquids {
public:
  VertexLiquids(const Scene& scene, const Frame& frame)
      : liquids_(scene, frame), numbers_(liquids_.numbers_at_vertices(frame)) {}
  [[nodiscard]] const Liquid& of(std::size_t vertex) const {
    return liquids_.all()[numbers_.empty() ? 0 : numbers_[vertex]];
  }

private:
  FrameLiquids liquids_;
  std::vector<std::uint32_t> numbers_;
};

// How far down the way to a solid is clear, of what is at that distance from it [m]: to a plane all of the way, which
// beside an upright one has no end, and would be gone in steps of that distance.
double clear_way(const scene::Solid& solid, const solid::SolidPoint& point, const Vector3& down) {
  if (!std::holds_alternative<scene::HalfSpace>(solid.shape) || !(point.distance > 0))
    return point.distance;
  const double slope = -point.normal.dot(down);
  return slope > 0 ? point.distance / slope : std::numeric_limits<double>::infinity();
}

bool falls(const Scene& scene) {
  return !scene.solids.empty() && scene.environment.gravity && scene.environment.gravity->norm() > 0;
}

} // namespace

std::optional<Landing> landing_below(const solid::Solids& solids, const Vector3d& down, const Vector3d& x, double size,
                                     double t) {
  constexpr double farthest = 100, near = 1e-3; // times the size
  double way = 0;
  while (way < farthest * size) {
    Landing nearest{.solid = 0,
                    .fall = way,
                    .place = x + way * down,
                    .there = {std::numeric_limits<double>::infinity(), -down, {}},
                    .liquid = {},
                    .vertex = 0};
    double clear = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const solid::SolidPoint point = solids.at(i, nearest.place, t);
      clear = std::min(clear, clear_way(solids.scene(i), point, down));
      if (point.distance < nearest.there.distance) {
        nearest.solid = i;
        nearest.there = point;
      }
    }
    if (nearest.there.distance < near * size)
      return nearest;
    way += clear;
  }
  return {};
}

std::vector<std::size_t> probes_of(const Frame& first) {
  constexpr std::size_t about = 100;
  const std::size_t apart = std::max<std::size_t>(1, first.vertices / about);
  std::vector<std::size_t> probes;
  for (std::size_t v = 0; v < first.vertices; v += apart)
    probes.push_back(v);
  return probes;
}

std::vector<Landing> landings(const Scene& scene, const Frame& first) {
  std::vector<Landing> all;
  if (!falls(scene))
    return all;
  const solid::Solids solids(scene);
  const auto x = positions(first);
  const Vector3d down = scene.environment.gravity->normalized();
  const double size = *measured(first).length;
  const VertexLiquids liquids(scene, first);
  for (const std::size_t v : probes_of(first))
    if (auto landing = landing_below(solids, down, x[v], size, first.time)) {
      landing->liquid = liquids.of(v);
      landing->vertex = v;
      all.push_back(std::move(*landing));
    }
  return all;
}

double longest_fall(const std::vector<Landing>& landings) {
  double longest = 0;
  for (const Landing& landing : landings)
    longest = std::max(longest, landing.fall);
  return longest;
}

double fall_time(const Scene& scene, const std::vector<Landing>& landings) {
  const Vector3 gravity = scene.environment.gravity.value_or(Vector3::Zero());
  const double fall = longest_fall(landings), g = gravity.norm();
  if (!(fall > 0))
    return 0;
  double slowest = std::numeric_limits<double>::infinity();
  for (const scene::SheetTable& sheet : scene.sheets)
    slowest = std::min(slowest, sheet.velocity.dot(gravity) / g);
  const double landing = std::sqrt(2 * g * fall);
  return slowest > landing ? (std::hypot(slowest, landing) - slowest) / g : std::sqrt(2 * fall / g);
}

std::optional<Landing> landing_of_inflow(const Scene& scene, const Frame& first, std::size_t number) {
  std::optional<Landing> shortest;
  if (!falls(scene))
    return shortest;
  const solid::Solids solids(scene);
  const Vector3d down = scene.environment.gravity->normalized();
  const double size = *measured(first).length;
  const auto inlets = masks(first, "inlet");
  for (std::size_t v = 0; v < inlets.size(); ++v)
    if (of_inlet(inlets[v], number) != 0)
      if (const auto landing = landing_below(solids, down, positions(first)[v], size, first.time);
          landing && (!shortest || landing->fall < shortest->fall))
        shortest = landing;
  if (shortest)
    shortest->liquid = scene::material_of(scene, sheet_named(scene, scene.inflows[number].sheet));
  return shortest;
}

double flux_onto(const Scene& scene, const Frame& first, std::size_t solid, double until) {
  double flux = 0;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const scene::Inflow& inflow = scene.inflows[i];
    const auto landing = landing_of_inflow(scene, first, i);
    if (landing && landing->solid == solid && inflow.until.value_or(until) >= until)
      flux = std::max(flux, inflow.thickness * scene::inlet_velocity(scene, inflow).speed(first.time));
  }
  return flux;
}

double fall_to_outflow(const Scene& scene, const Frame& first, std::size_t number) {
  const Vector3d down = scene.environment.gravity.value_or(Vector3d::Zero()).normalized();
  const solid::Solids solids(scene);
  const double size = measured(first).length.value_or(0);
  const auto inlets = masks(first, "inlet");
  double longest = 0;
  for (std::size_t v = 0; v < inlets.size() && !down.isZero(0); ++v) {
    double fall = std::numeric_limits<double>::infinity();
    const Vector3d& x = positions(first)[v];
    if (of_inlet(inlets[v], number) != 0)
      for (const scene::Outflow& outflow : scene.outflows)
        if (const double way = outflow.normal.dot(outflow.point - x); way > 0 && outflow.normal.dot(down) > 0)
          fall = std::min(fall, way / outflow.normal.dot(down));
    if (fall < std::numeric_limits<double>::infinity() && !landing_below(solids, down, x, size, first.time))
      longest = std::max(longest, fall);
  }
  return longest;
}

double speed_after_fall(const Scene& scene, double v0, const Landing& landing) {
  const double fall = landing.fall;
  const double g = scene.environment.gravity.value_or(Vector3d::Zero()).norm();
  const double viscous = v0 + fall * driven_rate(landing.liquid, landing.liquid.density * g * fall / 8);
  return std::min(std::sqrt(v0 * v0 + 2 * g * fall), viscous);
}

} // namespace sheet
