// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/drop_flight.h"

#include <algorithm>
#include <cmath>

#include "libsheet/scene/drop_densities.h"

namespace sheet {

namespace {

constexpr double ball_drag = 0.44;   // C
constexpr double most_slowed = 0.02; // of its speed in a part of a step, by the drag alone
constexpr double most_parts = 1e4;

} // namespace

DropMotion flown(const DropMotion& start, double radius, double duration, const DropForces& forces) {
  const double t = duration;
  if (forces.drag == 0)
    return {start.position + t * start.velocity + 0.5 * t * t * forces.gravity, start.velocity + t * forces.gravity};
  const double k = forces.drag / radius; // [1/m]
  const auto slows = [&](const Vector3& v) -> Vector3 {
    const Vector3 w = v - forces.wind;
    return forces.gravity - k * w.norm() * w;
  };
  const double fastest = (start.velocity - forces.wind).norm() + t * forces.gravity.norm();
  const double parts = std::clamp(std::ceil(k * fastest * t / most_slowed), 1.0, most_parts), dt = t / parts;
  DropMotion at = start;
  for (double part = 0; part < parts; ++part) {
    const Vector3 v = at.velocity, a1 = slows(v), a2 = slows(v + dt / 2 * a1), a3 = slows(v + dt / 2 * a2),
                  a4 = slows(v + dt * a3);
    at.position += dt * v + dt * dt / 6 * (a1 + a2 + a3);
    at.velocity += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return at;
}

void fly_drops(formats::Frame& frame, const Scene& scene, double start) {
  if (!knows_drops(frame))
    return;
  std::vector<Drop> drops = read_drops(frame);
  formats::Array starts = formats::make_standard_array("drop_start_position", drops.size());
  const std::vector<double> densities = scene::densities_of(drops, scene);
  const auto& air = scene.environment.air;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    Drop& drop = drops[i];
    starts.values<Vector3>()[i] = drop.position;
    if (!drop.flies())
      continue;
    DropForces forces{.gravity = scene.environment.gravity.value_or(Vector3::Zero())};
    if (air) {
      forces.wind = scene::value_at(air->wind, (start + frame.time) / 2);
      forces.drag = 0.375 * ball_drag * air->density / densities[i];
    }
    const DropMotion end = flown({drop.position, drop.velocity}, drop.radius(), frame.time - start, forces);
    drop.position = end.position;
    drop.velocity = end.velocity;
  }
  write_drops(frame, drops);
  frame.put(std::move(starts));
}

} // namespace sheet
