// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_squeeze.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/energy/layers.h"
#include "libsheet/energy/walls.h"

namespace sheet {

namespace {

// Of each vertex: what springs press with [N], all, and those that stand with it on a triangle or an edge.
struct Presses {
  std::vector<double> all, own;
};

Presses presses(const SpringRests& rests, const Stage& stage) {
  const std::span<const ContactSpring> springs = rests.springs();
  Presses force{std::vector<double>(stage.vertices(), 0), std::vector<double>(stage.vertices(), 0)};
  const std::vector<double> longer = rests.longer_at_last(stage);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const ContactSpring& s = springs[i];
    const Vector3 offset = s.sum([&](std::uint32_t v) {
      return stage.previous != nullptr ? stage.position(*stage.previous, v) : stage.start->positions[v];
    });
    const double press = -s.stiffness[0] * (s.gap(offset) - longer[i]);
    for (std::size_t c = 0; c < 4; ++c) {
      force.all[s.vertices[c]] += std::abs(s.weights[c]) * press;
      if (c == 0 || !s.of_vertex())
        force.own[s.vertices[c]] += std::abs(s.weights[c]) * press;
    }
  }
  return force;
}

// The mean around each vertex, by area, of what is added up at them, per area.
std::vector<double> per_area(const std::vector<double>& force, std::span<const double> area,
                             std::span<const Corners> triangles) {
  std::vector<double> sum(force.size(), 0), over(force.size(), 0);
  for (const Corners& c : triangles)
    for (const auto v : c)
      for (const auto other : c) {
        sum[v] += force[other];
        over[v] += area[other];
      }
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = over[v] > 0 ? sum[v] / over[v] : 0;
  return sum;
}

// What a layer feels, in the mean over its depth h, of pressures on its face, at vertices [Pa]: of one with the wave
// number k the part 1 - k² h²/6, as at the depth z it is (1 + k z) exp(-k z) of it [Turcotte and Schubert, Geodynamics,
// on postglacial rebound: a deep liquid below a load]. The mean over a triangle with sides e, then over a vertex's
// triangles, leaves 1 - k² e²/6, so that h²/e² times of it do; the sum of pressure times area stays. What is thinner
// than half an edge feels pressures as they are: such waves are none of its mesh, and a rim that presses stays sharp.
std::vector<double> felt_in_depth(std::vector<double> pressure, std::span<const Corners> triangles,
                                  std::span<const double> areas, std::span<const double> volumes) {
  constexpr double most = 16; // passes
  std::vector<double> around(pressure.size(), 0), passes(triangles.size(), 0);
  double needed = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double h = volumes[t] / areas[t], squared_side = 4 / std::sqrt(3.0) * areas[t];
    const double thick = std::sqrt(h * h / squared_side); // edges
    passes[t] = std::min(most, thick * thick * std::clamp(2 * thick - 1, 0.0, 1.0));
    for (const std::uint32_t v : triangles[t]) {
      around[v] += areas[t] / 3;
      needed = pressure[v] > 0 ? std::max(needed, passes[t]) : needed;
    }
  }
  const double rounds = std::ceil(needed);
  std::vector<double> flows(pressure.size());
  for (int round = 0; round < static_cast<int>(rounds); ++round) {
    std::ranges::fill(flows, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Corners& c = triangles[t];
      const double mean = (pressure[c[0]] + pressure[c[1]] + pressure[c[2]]) / 3;
      for (const std::uint32_t v : c)
        flows[v] += std::min(1.0, passes[t] / rounds) * areas[t] / 3 * (mean - pressure[v]);
    }
    for (std::size_t v = 0; v < pressure.size(); ++v)
      pressure[v] += around[v] > 0 ? flows[v] / around[v] : 0;
  }
  return pressure;
}

} // namespace

bool ContactSqueeze::from_above_only(const Stage& stage, std::uint32_t v) const {
  return site_at(stage, v) != nullptr || (bath_ && bath_->bears(v, stage.start->positions[v]));
}

void ContactSqueeze::begin(const Stage& stage) {
  const auto& triangles = stage.start->mesh->triangles;
  const auto& x = stage.start->positions;
  const LayerShares shares = layer_shares(stage);
  work_.assign(triangles.size(), 0);
  start_area_.assign(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    start_area_[t] = TriangleArea(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]).area;
  const Presses press = presses(*rests_, stage);
  const std::vector<double> all = per_area(press.all, shares.area, triangles),
                            own = per_area(press.own, shares.area, triangles);
  std::vector<double> pressure(stage.vertices());
  for (std::uint32_t v = 0; v < pressure.size(); ++v)
    pressure[v] = std::max(0.0, own[v]) / 2 + (from_above_only(stage, v) ? std::max(0.0, all[v]) / 2 : 0);
  pressure = felt_in_depth(std::move(pressure), triangles, start_area_, stage.start->volumes);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const auto v : triangles[t])
      if (of_layer(stage.start->volumes[t], start_area_[t]))
        work_[t] += pressure[v] / 3 * stage.start->volumes[t];
}

} // namespace sheet
