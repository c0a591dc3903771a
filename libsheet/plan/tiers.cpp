// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/tiers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "libsheet/material/flow_curve.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/inlet_width.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;

// The way from a place to where a box ends in a direction; infinity if it does not.
double way_out(const solid::Box3& box, const Vector3& x, const Vector3& direction) {
  double way = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > 1e-9)
      way = std::min(way, ((direction[i] > 0 ? box.max()[i] : box.min()[i]) - x[i]) / direction[i]);
  return std::max(0.0, way);
}

// The level direction in which a box ends first.
Vector3 nearest_side(const solid::Box3& box, const Vector3& x, const Vector3& down) {
  Vector3 nearest = Vector3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 axis = sign * Vector3::Unit(i), level = axis - axis.dot(down) * down;
      if (level.norm() < 0.5)
        continue;
      if (const double way = way_out(box, x, level.normalized()); way < least) {
        least = way;
        nearest = level.normalized();
      }
    }
  return nearest;
}

} // namespace

double time_over_tiers(const Scene& scene, const Frame& first, std::size_t inflow) {
  auto landing = landing_of_inflow(scene, first, inflow);
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, scene.inflows[inflow]);
  const double speed = velocity.speed(first.time), thickness = scene.inflows[inflow].thickness;
  double width = width_of_inlet(first, inflow);
  const double flux = width * thickness * speed;
  if (!landing || !(flux > 0))
    return 0;
  const Vector3 gravity = *scene.environment.gravity, down = gravity.normalized();
  const Liquid liquid = landing->liquid;
  const double g = gravity.norm(), rate = speed / thickness, viscosity = viscosity_of(liquid, {rate * rate});
  const Vector3 entering = value_at(velocity.common, first.time), level = entering - entering.dot(down) * down;
  constexpr double aslant = 0.3; // part of the speed
  const bool all_around = level.norm() < aslant * speed;
  Vector3 direction = all_around ? Vector3::Zero() : Vector3(level.normalized());
  const solid::Solids solids(scene);
  double time = 0;
  std::size_t tiers = 0;
  for (; landing && tiers < solids.size(); ++tiers) {
    const solid::Box3 box = solids.shape(landing->solid).bounds().transformed(solids.pose(landing->solid, first.time));
    if (scene.solids[landing->solid].contact != SolidContact::flow || !box.sizes().allFinite())
      break;
    if (direction.isZero(0))
      direction = nearest_side(box, landing->place, down);
    const double way = way_out(box, landing->place, direction), q = flux / width;
    const Vector3& normal = landing->there.normal;
    const double pull = (gravity - gravity.dot(normal) * normal).norm();
    const double filled = 0.8 * std::pow(12 * viscosity * q * way / (liquid.density * g), 0.25);
    const double running = std::cbrt(3 * viscosity * q / (liquid.density * pull));
    const double area = width * way + (all_around ? std::numbers::pi * way * way : 0);
    time += std::sqrt(2 * landing->fall / g) + std::min(filled, running) * area / flux;
    width += all_around ? 2 * std::numbers::pi * way : 0;
    const Vector3 over = landing->place + (way + thickness) * direction;
    landing = landing_below(solids, down, over, *measured(first).length, first.time);
  }
  return tiers > 1 ? time : 0;
}

} // namespace sheet
