// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_squeeze.h"

#include "libsheet/energy/layers.h"
#include "libsheet/energy/walls.h"

namespace sheet {

namespace {

// Of each vertex: what springs press with, added up [N].
std::vector<double> presses(std::span<const ContactSpring> springs, const Stage& stage) {
  std::vector<double> force(stage.vertices(), 0);
  for (const ContactSpring& s : springs) {
    const Vector3 offset = s.sum([&](std::uint32_t v) {
      return stage.previous != nullptr ? stage.position(*stage.previous, v) : stage.start->positions[v];
    });
    const double press = -s.stiffness[0] * s.gap(offset);
    for (std::size_t c = 0; c < 4 && press > 0; ++c)
      force[s.vertices[c]] += std::abs(s.weights[c]) * press;
  }
  return force;
}

} // namespace

bool ContactSqueeze::from_above_only(const Stage& stage, std::uint32_t v) const {
  return site_at(stage, v) != nullptr || (bath_ && bath_->bears(v, stage.start->positions[v]));
}

void ContactSqueeze::begin(const Stage& stage) {
  const auto& triangles = stage.start->mesh->triangles;
  const auto& x = stage.start->positions;
  const LayerShares shares = layer_shares(stage);
  const std::vector<double> force = presses(springs_, stage);
  work_.assign(triangles.size(), 0);
  start_area_.assign(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const auto v : triangles[t])
      work_[t] += (from_above_only(stage, v) ? 1 : 0.5) * force[v] / shares.area[v] / 3 * stage.start->volumes[t];
    start_area_[t] = TriangleArea(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]).area;
  }
}

} // namespace sheet
