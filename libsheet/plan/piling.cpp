// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/piling.h"

#include <algorithm>
#include <cmath>

#include "libsheet/geometry/area.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using formats::Frame;

constexpr double long_fall = 3; // thicknesses

// Whether what lands there with that speed [m/s] is not drawn away faster by a belt.
bool piles_up(const Landing& landing, double speed, double thickness) {
  return landing.fall > long_fall * thickness && landing.there.velocity.norm() < speed;
}

// Whether the most of it is steeper than 60 degrees.
bool is_upright(const Scene& scene, const Frame& first) {
  const Vector3d down = scene.environment.gravity->normalized();
  const auto x = positions(first);
  double area = 0, below = 0;
  for (const Corners& c : triangles(first)) {
    const TriangleArea triangle(x[c[0]], x[c[1]], x[c[2]]);
    area += triangle.area;
    below += std::abs((x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(down)) / 2;
  }
  return below < area / 2;
}

} // namespace

bool inflow_piles_up(const Scene& scene, const Frame& first, std::size_t number, const Landing& landing) {
  const scene::Inflow& inflow = scene.inflows[number];
  const double v0 = scene::inlet_velocity(scene, inflow).speed(first.time);
  return piles_up(landing, speed_after_fall(scene, v0, landing), inflow.thickness);
}

std::optional<Piling> what_piles_up(const Scene& scene, const Frame& first, const std::vector<Landing>& all) {
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    if (const auto landing = landing_of_inflow(scene, first, i); landing && inflow_piles_up(scene, first, i, *landing))
      return Piling{"what flows in", landing->solid};
  if (all.empty() || !scene.holds.empty() || !scene.inflows.empty() || scene.environment.pressure ||
      !is_upright(scene, first))
    return std::nullopt;
  const auto landing = std::ranges::max_element(all, {}, &Landing::fall);
  if (!piles_up(*landing, speed_after_fall(scene, 0, *landing), *measured(first).thickness))
    return std::nullopt;
  return Piling{"the upright sheet", landing->solid};
}

} // namespace sheet
