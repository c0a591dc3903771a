// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/inlet_velocity.h"

#include <algorithm>
#include <cmath>

namespace sheet::scene {

Vector3d InletVelocity::at(double t, const Vector3d& x) const {
  const Vector3d same = value_at(common, t);
  return fans_out() ? Vector3d(same + value_at(radial, t) * axis.outward(x)) : same;
}

Vector3d InletVelocity::way(double from, double to, const Vector3d& x) const {
  const Vector3d same = integral(common, from, to);
  return fans_out() ? Vector3d(same + integral(radial, from, to) * axis.outward(x)) : same;
}

double InletVelocity::speed(double t) const { return std::hypot(value_at(common, t).norm(), value_at(radial, t)); }

std::vector<double> InletVelocity::times() const {
  std::vector<double> times;
  for (const auto& entry : common.entries)
    times.push_back(entry.time);
  for (const auto& entry : radial.entries)
    times.push_back(entry.time);
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

InletVelocity inlet_velocity(const Scene& scene, const Inflow& inflow) {
  return {inflow.velocity, inflow.radial_velocity, axis_of(sheet_named(scene, inflow.sheet))};
}

} // namespace sheet::scene
