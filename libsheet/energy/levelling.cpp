// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/levelling.h"

#include <algorithm>
#include <cmath>

#include "libsheet/energy/walls.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

namespace {

constexpr double most_in_a_step = 1.0 / 8; // of the smaller area: with three edges no triangle gets a new extreme

struct Layers {
  std::vector<double> area, thickness, rest; // of triangles; rest: h - H
  std::vector<char> at_rim;                  // with a corner at a rim that is free: its steep profile is no unevenness
};

// What values at triangles have beyond the mean of the means around their corners. volumes: values times areas.
std::vector<double> rest_of(const State& state, std::vector<double> values, std::span<const double> volumes,
                            std::span<const double> area) {
  const auto& triangles = state.mesh->triangles;
  const std::vector<double> around =
      thickness_around(state.positions.size(), triangles, volumes, [&](std::uint32_t t) { return area[t]; });
  for (std::size_t t = 0; t < values.size(); ++t)
    values[t] -= (around[triangles[t][0]] + around[triangles[t][1]] + around[triangles[t][2]]) / 3;
  return values;
}

// H: means of thickness around the corners, of these the mean. sloped: of h - H again what is beyond its means.
Layers layers_of(const State& state, std::span<const char> held, bool sloped) {
  const auto& triangles = state.mesh->triangles;
  const auto& x = state.positions;
  Layers layers;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[t];
    layers.area.push_back(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
    layers.thickness.push_back(state.volumes[t] / layers.area[t]);
  }
  layers.rest = rest_of(state, layers.thickness, state.volumes, layers.area);
  std::vector<char> on_rim(x.size(), 0);
  for (std::size_t e = 0; e < state.mesh->edges.size(); ++e)
    if (state.mesh->on_rim(e))
      for (const auto v : state.mesh->edges[e])
        on_rim[v] = held.empty() || (held[3 * v] == 0 && held[3 * v + 1] == 0 && held[3 * v + 2] == 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& c = triangles[t];
    layers.at_rim.push_back(on_rim[c[0]] != 0 || on_rim[c[1]] != 0 || on_rim[c[2]] != 0);
  }
  if (sloped) { // without what is at the rim, where means are of one side
    std::vector<double> area(layers.area), volumes(layers.rest);
    for (std::size_t t = 0; t < area.size(); ++t) {
      area[t] *= layers.at_rim[t] != 0 ? 0 : 1;
      volumes[t] *= area[t];
    }
    layers.rest = rest_of(state, std::move(layers.rest), volumes, area);
  }
  return layers;
}

Vector3 middle_of(const State& state, std::uint32_t t) {
  const Corners& c = state.mesh->triangles[t];
  return (state.positions[c[0]] + state.positions[c[1]] + state.positions[c[2]]) / 3;
}

// Of volume and momentum (over the density) around the vertices.
struct Carried {
  explicit Carried(const State& state)
      : volume(vertex_shares(state.positions.size(), state.mesh->triangles,
                             [&](std::uint32_t t) { return state.volumes[t]; })),
        momentum(state.positions.size()) {
    for (std::size_t v = 0; v < volume.size(); ++v)
      momentum[v] = volume[v] * state.velocities[v];
  }

  // What goes takes the mean velocity of its triangle with it.
  void move(const State& state, double amount, std::uint32_t from, std::uint32_t to) {
    Vector3 velocity = Vector3::Zero();
    for (const auto v : state.mesh->triangles[from]) {
      velocity += state.velocities[v] / 3;
      volume[v] -= amount / 3;
      momentum[v] -= amount / 3 * state.velocities[v];
    }
    for (const auto v : state.mesh->triangles[to]) {
      volume[v] += amount / 3;
      momentum[v] += amount / 3 * velocity;
    }
  }

  std::vector<double> volume;
  std::vector<Vector3> momentum;
};

// How fast unevenness of the size of an edge flows across it, a step of thickness over `apart` [m²/s]; 0 where nothing
// drags.
double diffusivity(const WallSite& one, const WallSite& other, const Stage& stage,
                   const std::array<std::uint32_t, 2>& sides, const Vector3& gravity, double h, double step,
                   double apart) {
  if (one.slip_length == free_slip || other.slip_length == free_slip)
    return 0;
  const double tension = 0.5 * (stage.surface_tension(sides[0]) + stage.surface_tension(sides[1]));
  const auto shift_of = [&](std::uint32_t t) { return stage.shift_of(t) * wall_shift(stage, t, one); };
  const double shift = 0.5 * (shift_of(sides[0]) + shift_of(sides[1]));
  const double towards = std::max(0.0, -gravity.dot(one.normal + other.normal) / 2);
  const auto& [liquid, flow, lagged, wall_flow] = stage.liquid_of(sides[0]);
  const double stiffness = liquid.density * towards + tension / (apart * apart);
  const double slip = std::min(one.slip_length, other.slip_length);
  if (wall_flow)
    return wall_flow->velocity(stiffness * h * step / apart, h, slip) * h * apart / (step * shift);
  return stiffness * h * h * (h + 3 * slip) / (3 * shift * liquid.viscosity);
}

// What is given takes its heat with it.
void mix_in(double temperature, double amount, double& of_taker, double volume) {
  of_taker = (volume * of_taker + amount * temperature) / (volume + amount);
}

} // namespace

bool level_layers(const Stage& stage, const Vector3& gravity, const std::vector<Hold>& holds, bool sloped, double dt,
                  State& end) {
  if (stage.sites.empty() || !stage.viscous())
    return false;
  const Connectivity& mesh = *end.mesh;
  const Layers layers = layers_of(end, held_unknowns(holds, stage), sloped);
  Carried carried(end);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    auto [up, down] = mesh.edge_triangles[e];
    const auto [a, b] = mesh.edges[e];
    const WallSite *one = site_at(stage, a), *other = site_at(stage, b);
    if (mesh.on_rim(e) || one == nullptr || other == nullptr || layers.at_rim[up] != 0 || layers.at_rim[down] != 0)
      continue;
    if (layers.thickness[up] < layers.thickness[down])
      std::swap(up, down);
    const double step = layers.thickness[up] - layers.thickness[down];
    const double rest = std::min(step, layers.rest[up] - layers.rest[down]);
    if (rest <= 0)
      continue;
    const double length = (end.positions[b] - end.positions[a]).norm();
    const double apart = (middle_of(end, up) - middle_of(end, down)).norm();
    const double h = (layers.thickness[up] + layers.thickness[down]) / 2;
    const double amount =
        rest * std::min(diffusivity(*one, *other, stage, mesh.edge_triangles[e], gravity, h, rest, apart) * dt *
                            length / apart,
                        most_in_a_step * std::min(layers.area[up], layers.area[down]));
    if (!end.temperatures.empty())
      mix_in(end.temperatures[up], amount, end.temperatures[down], end.volumes[down]);
    end.volumes[up] -= amount;
    end.volumes[down] += amount;
    carried.move(end, amount, up, down);
  }
  for (const WallSite& site : stage.sites)
    end.velocities[site.vertex] = carried.momentum[site.vertex] / carried.volume[site.vertex];
  return true;
}

} // namespace sheet
