// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_damping.h"

#include <cmath>

#include "libsheet/energy/layers.h"

namespace sheet {

namespace {

// Of what is around the corners of both features; of two liquids, one behind the other.
double viscosity_between(const ContactSpring& s, const Stage& stage, std::span<const double> viscosities) {
  if (stage.liquids.size() < 2 || stage.vertex_liquids[s.vertices[0]] == stage.vertex_liquids[s.vertices[3]])
    return mean_between(s, viscosities);
  const double one = s.mean_of_corners(0, s.second_feature(), viscosities),
               other = s.mean_of_corners(s.second_feature(), 4, viscosities);
  return 2 * one * other / (one + other);
}

} // namespace

void ContactDamping::begin(const Stage& stage) {
  const LayerShares shares = layer_shares(stage);
  const std::vector<double> viscosities = vertex_means(stage, stage.viscosity);
  dampers_.assign(size(), {});
  for (std::size_t i = 0; i < size(); ++i) {
    const ContactSpring& s = spring(i);
    const double area = s.area(shares.area), h = s.mean(shares.thickness);
    const auto density_at = [&](std::size_t corner) { return stage.liquid_at(s.vertices[corner]).liquid.density; };
    const double density = inertia_ ? (density_at(0) + density_at(3)) / 2 : 0; // of one feature and of the other
    const auto critical = [&](double k) { return std::sqrt(2 * k * area * density * h); };
    dampers_[i].normal =
        (0.5 * viscosity_between(s, stage, viscosities) * h + critical(s.stiffness[0])) / stage.duration;
    dampers_[i].tangential = critical(s.stiffness[1]) / stage.duration;
    dampers_[i].before = s.sum([&](std::uint32_t v) { return reference_position(stage, v); });
  }
}

} // namespace sheet
