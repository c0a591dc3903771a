// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of two liquids in one model: what does not touch goes on as if it were alone, and layers that touch exchange
// the stress that both bear.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/energy/contact_shear.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// A disk far to the right, of the numbered liquid.
State disk_at(double x, std::uint32_t liquid) {
  State s = test::at_rest(test::disk(1, 3, 0.2), 0.05);
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    s.positions[v].z() = 0.05 * std::sin(3 * s.positions[v].x());
    s.velocities[v] = {0, 0, s.positions[v].x() * s.positions[v].y()};
    s.positions[v].x() += x;
  }
  s.liquids.assign(s.volumes.size(), liquid);
  return s;
}

State both(const State& a, const State& b) {
  State s = a;
  std::vector<Corners> triangles = a.mesh->triangles;
  for (Corners c : b.mesh->triangles) {
    for (std::uint32_t& v : c)
      v += static_cast<std::uint32_t>(a.positions.size());
    triangles.push_back(c);
  }
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(s.positions, b.positions);
  add(s.velocities, b.velocities);
  add(s.volumes, b.volumes);
  add(s.liquids, b.liquids);
  s.mesh = std::make_shared<const Connectivity>(connect(s.positions.size(), triangles));
  return s;
}

Model model_of(const Liquid& liquid) {
  Model m;
  m.liquid = liquid;
  m.gravity = {0, 0, -9.81};
  m.bending = Bending::mid_edge;
  m.arcs = true;
  return m;
}

// Everything that knows a liquid: inertia, weight, tension, stretching, bending, what yields.
TEST(TwoLiquids, WhatDoesNotTouchGoesOnAsIfItWereAlone) {
  const Liquid newtonian{.viscosity = 20, .density = 900, .surface_tension = 0.5};
  const Liquid yields{
      .viscosity = 8, .density = 1400, .surface_tension = 2, .law = {.kind = FlowLawKind::casson, .yield_stress = 15}};
  const Liquid thins{.viscosity = 60, .density = 1100, .law = {.kind = FlowLawKind::power, .flow_index = 0.5}};
  for (const auto& [one, other] :
       {std::pair{newtonian, yields}, std::pair{yields, thins}, std::pair{newtonian, thins}}) {
    Model model = model_of(one);
    model.other_liquids = {other};
    StepOptions options;
    options.newton.tolerance = 1e-10;
    State a = disk_at(0, 0), b = disk_at(10, 0), together = both(disk_at(0, 0), disk_at(10, 1));
    Stepper alone(model_of(one), options), other_alone(model_of(other), options), stepper(model, options);
    for (int i = 0; i < 3; ++i) {
      alone.step(a, 0.01);
      other_alone.step(b, 0.01);
      stepper.step(together, 0.01);
    }
    double apart = 0, way = 0;
    for (std::size_t v = 0; v < together.positions.size(); ++v) {
      const std::size_t n = a.positions.size();
      apart = std::max(apart, (together.positions[v] - (v < n ? a.positions[v] : b.positions[v - n])).norm());
      way = std::max(way, (together.positions[v] - both(disk_at(0, 0), disk_at(10, 0)).positions[v]).norm());
    }
    EXPECT_GT(way, 1e-3);
    EXPECT_LT(apart, 1e-7);
  }
}

// A triangle under a vertex of another layer, which slides along it.
struct Layers {
  State state;
  std::vector<ContactSpring> springs;
};

Layers two_layers(double lower, double upper) {
  Layers layers;
  const State below = test::at_rest(test::rectangle(1, 1, 2, 2, 0), lower);
  State above = test::at_rest(test::rectangle(1, 1, 2, 2, 0), upper);
  for (Vector3& x : above.positions)
    x.z() += (lower + upper) / 2;
  layers.state = both(below, above);
  layers.state.liquids.assign(below.volumes.size(), 0);
  layers.state.liquids.resize(layers.state.volumes.size(), 1);
  ContactSpring s;
  const Corners& c = below.mesh->triangles[0];
  s.vertices = {static_cast<std::uint32_t>(below.positions.size() + c[0]), c[0], c[1], c[2]};
  s.weights = {1, -1, 0, 0};
  s.rest = (lower + upper) / 2;
  layers.springs = {s};
  return layers;
}

// In a stack each layer is sheared over half of its thickness: with one stress, u = τ (h/2μ + h'/2μ').
TEST(TwoLiquids, LayersBearOneStress) {
  constexpr double lower = 0.02, upper = 0.01, duration = 0.1;
  const Layers layers = two_layers(lower, upper);
  for (const auto& [below, above] : {std::pair{3.0, 50.0}, std::pair{50.0, 3.0}, std::pair{7.0, 7.0 * (1 + 1e-9)}}) {
    const std::vector<Liquid> liquids{{.viscosity = below, .density = 1000}, {.viscosity = above, .density = 1000}};
    const auto rests = std::make_shared<SpringRests>(layers.springs, true, *layers.state.mesh);
    ContactShear shear(rests);
    const Stage stage = first_stage(layers.state, liquids, duration, duration, false);
    rests->begin(stage);
    shear.begin(stage);
    const double way = 1e-3;
    VectorN<12> u, gradient;
    MatrixN<12> hessian;
    for (Eigen::Index i = 0; i < 4; ++i)
      u.segment<3>(3 * i) = layers.state.positions[layers.springs[0].vertices[static_cast<std::size_t>(i)]];
    u[0] += way;
    shear.derivatives(0, u, gradient, hessian, false);
    double area = 0; // half of the vertex' own, a third of its triangles
    for (std::size_t t = 0; t < layers.state.volumes.size(); ++t)
      for (const auto v : layers.state.mesh->triangles[t])
        area += v == layers.springs[0].vertices[0] ? 0.5 * layers.state.volumes[t] / upper / 3 : 0;
    const double stress = way / duration / (lower / (2 * below) + upper / (2 * above));
    EXPECT_NEAR(gradient[0], stress * area, 1e-7 * stress * area);
  }
}

} // namespace
} // namespace sheet
