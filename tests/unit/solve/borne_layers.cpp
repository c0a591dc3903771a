// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that lie on each other on a bath: only the lowest one that faces up touches it.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/solve/borne_layers.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double layer_depth = 0.05, weight_of_kg = 10, bath_density = 1000;
constexpr double spring_stiffness = 1e8; // of springs for each square metre [N/m³]

// Strips of 2 m by 1 m, one above the other by their thickness, the lowest one first; each vertex is over that below
// it.
struct FloatingStack {
  State state;
  std::vector<ContactSpring> springs;
  std::size_t size = 0; // vertices of a layer

  explicit FloatingStack(const std::vector<bool>& face_up, const Vector3& up = Vector3::UnitZ()) {
    const test::Mesh mesh = test::rectangle(2, 1, 8, 4, 0.2);
    size = mesh.positions.size();
    test::Mesh all;
    for (std::uint32_t layer = 0; layer < face_up.size(); ++layer)
      add_layer(mesh, layer, face_up[layer], up, all);
    state = test::at_rest(all, layer_depth);
  }

  [[nodiscard]] std::vector<char> borne() const {
    return borne_layers(state.positions, state.mesh->triangles, springs, Vector3::UnitZ());
  }
  [[nodiscard]] double mean(std::size_t layer, int axis) const {
    double sum = 0;
    for (std::size_t v = layer * size; v < (layer + 1) * size; ++v)
      sum += state.positions[v][axis] / static_cast<double>(size);
    return sum;
  }

private:
  void add_layer(const test::Mesh& mesh, std::uint32_t layer, bool face_up, const Vector3& up, test::Mesh& all) {
    const auto offset = static_cast<std::uint32_t>(layer * size);
    std::vector<double> area(size, 0);
    std::vector<Corners> of(size);
    for (Corners c : mesh.triangles) {
      const double third =
          (mesh.positions[c[1]] - mesh.positions[c[0]]).cross(mesh.positions[c[2]] - mesh.positions[c[0]]).norm() / 6;
      for (std::size_t k = 0; k < 3; ++k) {
        area[c[k]] += third;
        of[c[k]] = {c[k], c[(k + 1) % 3], c[(k + 2) % 3]};
      }
      if (!face_up)
        std::swap(c[1], c[2]);
      all.triangles.push_back({c[0] + offset, c[1] + offset, c[2] + offset});
    }
    for (std::uint32_t v = 0; v < size; ++v) {
      all.positions.push_back(mesh.positions[v] + layer_depth * layer * up);
      if (layer == 0)
        continue;
      const auto below = static_cast<std::uint32_t>(offset - size);
      springs.push_back({.vertices = {v + offset, of[v][0] + below, of[v][1] + below, of[v][2] + below},
                         .weights = {1, -1, 0, 0},
                         .normal = up,
                         .rest = layer_depth,
                         .stiffness = {spring_stiffness * area[v], 0}});
    }
  }
};

std::vector<char> of_each_layer(const std::vector<char>& borne, std::size_t size) {
  std::vector<char> of;
  for (std::size_t v = 0; v < borne.size(); v += size) {
    EXPECT_EQ(std::count(borne.begin() + static_cast<std::ptrdiff_t>(v),
                         borne.begin() + static_cast<std::ptrdiff_t>(v + size), borne[v]),
              static_cast<std::ptrdiff_t>(size));
    of.push_back(borne[v]);
  }
  return of;
}

TEST(BorneLayers, WhatIsAboveTheLowestLayerThatFacesUp) {
  const auto of = [](const std::vector<bool>& face_up) {
    const FloatingStack stack(face_up);
    return of_each_layer(stack.borne(), stack.size);
  };
  EXPECT_EQ(of({true}), std::vector<char>{});
  EXPECT_EQ(of({true, true}), (std::vector<char>{0, 1}));
  EXPECT_EQ(of({true, false, true}), (std::vector<char>{0, 1, 1})); // a fold
  EXPECT_EQ(of({false, true, true}), (std::vector<char>{0, 0, 1})); // the lowest is wet on both faces
  EXPECT_EQ(of({false, false}), (std::vector<char>{0, 0}));
  EXPECT_TRUE(FloatingStack({true, true}, Vector3(0.9, 0, 0.4).normalized()).borne().empty()); // one beside the other
}

Model on_bath(const FloatingStack& stack, double lower, double upper) {
  Model m;
  m.liquid = {.viscosity = 100, .density = lower};
  if (upper != lower)
    m.other_liquids = {{.viscosity = 300, .density = upper}};
  m.gravity = {0, 0, -weight_of_kg};
  m.bath = BathLiquid{.density = bath_density};
  m.contacts = stack.springs;
  m.borne = stack.borne();
  m.inertia = false;
  return m;
}

// As layer_depth as both displace of the bath, the springs between them pressed by the weight of the upper one.
TEST(BorneLayers, TwoLayersFloatAsDeepAsBothWeigh) {
  for (const auto& [lower, upper] : {std::pair{900.0, 900.0}, std::pair{900.0, 600.0}}) {
    FloatingStack stack({true, true});
    if (upper != lower) {
      stack.state.liquids.assign(stack.state.volumes.size(), 0);
      std::fill(stack.state.liquids.begin() + static_cast<std::ptrdiff_t>(stack.state.volumes.size() / 2),
                stack.state.liquids.end(), 1);
    }
    Model m = on_bath(stack, lower, upper);
    Hold along;
    for (std::uint32_t v = 0; v < stack.state.positions.size(); ++v)
      along.vertices.push_back(v);
    along.axes = static_cast<Axes>(axis_bit(0) | axis_bit(1));
    m.holds = {along};
    Stepper stepper(m, {});
    for (int i = 0; i < 20; ++i)
      stepper.step(stack.state, 1);
    const double depth = (lower + upper) * layer_depth / bath_density;
    EXPECT_NEAR(stack.mean(0, 2), -depth, 1e-6 * depth);
    EXPECT_NEAR(stack.mean(1, 2) - stack.mean(0, 2),
                layer_depth - upper * layer_depth * weight_of_kg / spring_stiffness, 1e-6 * layer_depth);
  }
}

// On a bath twice as dense each layer's thrust is half its own weight's: both go on as one of twice the thickness.
TEST(BorneLayers, TwoLayersSpreadAsOneOfTwiceTheThickness) {
  FloatingStack stack({true, true});
  constexpr double density = bath_density / 2, press = density * layer_depth * weight_of_kg; // [Pa]
  for (std::size_t v = 0; v < stack.state.positions.size(); ++v)
    stack.state.positions[v].z() = -layer_depth + (v < stack.size ? 0 : layer_depth - press / spring_stiffness);
  Model m = on_bath(stack, density, density);
  m.bath->spreads = true;
  m.contacts_flow = true;
  Hold ends, sides;
  for (std::uint32_t v = 0; v < stack.state.positions.size(); ++v) {
    sides.vertices.push_back(v);
    if (stack.state.positions[v].x() < 1e-6)
      ends.vertices.push_back(v);
  }
  ends.axes = axis_bit(0);
  sides.axes = axis_bit(1);
  m.holds = {ends, sides};
  const double rate = press / (8 * m.liquid.viscosity),
               duration = 0.002 / rate; // ρ g' (2 h)²/2 = 4 μ (2 h) ε, g' = g/2
  const double before = stack.mean(0, 0);
  Stepper(m, {}).step(stack.state, duration);
  for (const std::size_t layer : {0, 1})
    EXPECT_NEAR(stack.mean(layer, 0) / before - 1, rate * duration, 0.01 * rate * duration) << layer;
}

} // namespace
} // namespace sheet
