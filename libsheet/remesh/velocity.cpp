// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/velocity.h"

#include <algorithm>
#include <cmath>

namespace sheet::remesh {

namespace {

Flow flow_of(std::span<const MovingVertex> vertices) {
  Flow flow;
  for (const MovingVertex& v : vertices)
    flow.add(v.volume, *v.velocity);
  return flow;
}

} // namespace

void restore_flow(const Flow& before, std::span<const MovingVertex> vertices) {
  Vector3 free_volume = Vector3::Zero(), mean = Vector3::Zero();
  const auto for_free = [&](auto visit) {
    for (const MovingVertex& v : vertices)
      for (int axis = 0; axis < 3; ++axis)
        if (!has_axis(v.held, axis))
          visit(v.volume, (*v.velocity)[axis], axis);
  };
  for_free([&](double volume, double, int axis) { free_volume[axis] += volume; });
  const Vector3 missing = before.momentum - flow_of(vertices).momentum;
  for_free([&](double volume, double& u, int axis) {
    u += missing[axis] / free_volume[axis];
    mean[axis] += volume / free_volume[axis] * u;
  });
  const double excess = flow_of(vertices).energy - before.energy;
  if (!(excess > 0))
    return;
  double relative = 0;
  for_free([&](double volume, double u, int axis) { relative += 0.5 * volume * (u - mean[axis]) * (u - mean[axis]); });
  const double scale = relative > excess ? std::sqrt(1 - excess / relative) : 0;
  for_free([&](double, double& u, int axis) { u = mean[axis] + scale * (u - mean[axis]); });
}

} // namespace sheet::remesh
