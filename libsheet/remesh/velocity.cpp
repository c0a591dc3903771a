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
  double free_volume = 0;
  for (const MovingVertex& v : vertices)
    if (!v.held)
      free_volume += v.volume;
  if (!(free_volume > 0))
    return;
  const Vector3 push = (before.momentum - flow_of(vertices).momentum) / free_volume;
  Vector3 mean = Vector3::Zero();
  for (const MovingVertex& v : vertices)
    if (!v.held) {
      *v.velocity += push;
      mean += v.volume / free_volume * *v.velocity;
    }
  const double excess = flow_of(vertices).energy - before.energy;
  if (!(excess > 0))
    return;
  double relative = 0;
  for (const MovingVertex& v : vertices)
    if (!v.held)
      relative += 0.5 * v.volume * (*v.velocity - mean).squaredNorm();
  const double scale = relative > excess ? std::sqrt(1 - excess / relative) : 0;
  for (const MovingVertex& v : vertices)
    if (!v.held)
      *v.velocity = mean + scale * (*v.velocity - mean);
}

} // namespace sheet::remesh
