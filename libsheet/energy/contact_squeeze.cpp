// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_squeeze.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/energy/layers.h"
#include "libsheet/energy/walls.h"

namespace sheet {

namespace {

// Of each vertex, once; `normals` of its triangles.
std::vector<ContactSqueeze::Press> presses(std::span<const ContactSpring> springs, const Stage& stage,
                                           std::span<const Vector3> normals) {
  std::vector<ContactSqueeze::Press> of(stage.vertices());
  for (const ContactSpring& s : springs) {
    const Vector3 offset = s.sum([&](std::uint32_t v) {
      return stage.previous != nullptr ? stage.position(*stage.previous, v) : stage.start->positions[v];
    });
    const double press = -s.stiffness[0] * s.gap(offset);
    for (std::size_t c = 0; c < 4 && press > 0; ++c) {
      const Vector3 force = s.weights[c] * press * s.normal;
      ContactSqueeze::Press& to = of[s.vertices[c]];
      to.on_side[force.dot(normals[s.vertices[c]]) < 0 ? 0 : 1] += std::abs(s.weights[c]) * press;
      to.force += force;
    }
  }
  return of;
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

// Forces and masses of vertices that no wall or bath bears, added up over the triangles at each, so that a vertex which
// by chance no spring bears counts as what is around it.
std::vector<ContactSqueeze::Borne> ContactSqueeze::borne_around(const Stage& stage,
                                                                std::span<const Press> press) const {
  const auto& triangles = stage.start->mesh->triangles;
  std::vector<Borne> own(stage.vertices()), around(stage.vertices());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t v : triangles[t])
      own[v].mass += stage.liquid_of(t).liquid.density * stage.start->volumes[t] / 3;
  for (std::uint32_t v = 0; v < own.size(); ++v)
    own[v] = from_above_only(stage, v) ? Borne{} : Borne{press[v].force, own[v].mass};
  for (const Corners& corners : triangles) {
    const Borne sum = own[corners[0]] + own[corners[1]] + own[corners[2]];
    for (const std::uint32_t v : corners)
      around[v] = around[v] + sum;
  }
  return around;
}

// ρ g_b V²/2 of a triangle, in the part of its corners that nothing but layers may bear.
double ContactSqueeze::own_thrust(const Stage& stage, std::size_t t, const Vector3& normal,
                                  std::span<const Borne> borne) const {
  const Vector3 up = normal.dot(gravity_) > 0 ? Vector3(-normal) : normal;
  Borne sum;
  double part = 0;
  for (const std::uint32_t v : stage.start->mesh->triangles[t]) {
    sum = sum + borne[v];
    part += from_above_only(stage, v) ? 0 : 1.0 / 3;
  }
  if (!(sum.mass > 0))
    return 0;
  const double gravity = std::max(0.0, std::min(-gravity_.dot(up), sum.force.dot(up) / sum.mass));
  const double volume = stage.start->volumes[t];
  return part * stage.liquid_of(t).liquid.density * gravity * volume * volume / 2;
}

void ContactSqueeze::begin(const Stage& stage) {
  const auto& triangles = stage.start->mesh->triangles;
  const auto& x = stage.start->positions;
  const LayerShares shares = layer_shares(stage);
  work_.assign(triangles.size(), 0);
  thrust_.assign(triangles.size(), 0);
  start_area_.assign(triangles.size(), 1);
  std::vector<Vector3> across(triangles.size()), normals(stage.vertices(), Vector3::Zero());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const TriangleArea a(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]);
    start_area_[t] = a.area;
    across[t] = a.normal;
    for (const auto v : triangles[t])
      normals[v] += a.area * a.normal;
  }
  const std::vector<Press> press = presses(springs_, stage, normals);
  std::vector<double> pressure(stage.vertices(), 0);
  for (std::uint32_t v = 0; v < pressure.size(); ++v) {
    const auto [one, other] = press[v].on_side;
    pressure[v] =
        one + other > 0 ? (from_above_only(stage, v) ? one + other : std::min(one, other)) / shares.area[v] : 0;
  }
  const std::vector<Borne> borne = borne_around(stage, press);
  pressure = felt_in_depth(std::move(pressure), triangles, start_area_, stage.start->volumes);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const auto v : triangles[t])
      work_[t] += pressure[v] / 3 * stage.start->volumes[t];
    thrust_[t] = own_thrust(stage, t, across[t], borne);
  }
}

} // namespace sheet
