// SPDX-License-Identifier: GPL-3.0-or-later
// What a bath reaches: of layers that lie on each other the lowest one that faces up; all that has gone under.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/solve/bath_reach.h"
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

  // shut: whether nothing comes over their rims.
  [[nodiscard]] std::vector<BathReach> reach(bool shut = false) const {
    return bath_reach(
        {*state.mesh, state.positions, state.volumes, springs, std::vector<char>(state.positions.size(), shut ? 1 : 0)},
        Vector3::UnitZ(), 0);
  }
  void sink(double depth) {
    for (Vector3& x : state.positions)
      x.z() -= depth;
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
    const auto below = static_cast<std::uint32_t>(offset - size);
    for (Corners c : mesh.triangles) {
      const double third =
          (mesh.positions[c[1]] - mesh.positions[c[0]]).cross(mesh.positions[c[2]] - mesh.positions[c[0]]).norm() / 6;
      for (std::size_t k = 0; k < 3 && layer > 0; ++k) // on each of its triangles a part of it
        springs.push_back({.vertices = {c[k] + offset, c[k] + below, c[(k + 1) % 3] + below, c[(k + 2) % 3] + below},
                           .weights = {1, -1, 0, 0},
                           .normal = up,
                           .rest = layer_depth,
                           .stiffness = {spring_stiffness * third, 0}});
      if (!face_up)
        std::swap(c[1], c[2]);
      all.triangles.push_back({c[0] + offset, c[1] + offset, c[2] + offset});
    }
    for (std::uint32_t v = 0; v < size; ++v)
      all.positions.push_back(mesh.positions[v] + layer_depth * layer * up);
  }
};

// None where they are all below.
std::vector<BathReach> of_each_layer(const std::vector<BathReach>& reach, std::size_t size) {
  std::vector<BathReach> of;
  for (std::size_t v = 0; v < reach.size(); v += size) {
    EXPECT_EQ(std::count(reach.begin() + static_cast<std::ptrdiff_t>(v),
                         reach.begin() + static_cast<std::ptrdiff_t>(v + size), reach[v]),
              static_cast<std::ptrdiff_t>(size));
    of.push_back(reach[v]);
  }
  return of;
}

using OfLayers = std::vector<BathReach>;

TEST(BathReach, WhatIsAboveTheLowestLayerThatFacesUp) {
  using enum BathReach;
  const auto of = [](const std::vector<bool>& face_up) {
    const FloatingStack stack(face_up);
    return of_each_layer(stack.reach(), stack.size);
  };
  EXPECT_EQ(of({true}), OfLayers{});
  EXPECT_EQ(of({true, true}), (OfLayers{below, none}));
  EXPECT_EQ(of({true, false, true}), (OfLayers{below, none, none})); // a fold
  EXPECT_EQ(of({false, true, true}), (OfLayers{facing, none, none}));
  EXPECT_EQ(of({false, false}), (OfLayers{facing, none}));
  EXPECT_TRUE(FloatingStack({true, true}, Vector3(0.9, 0, 0.4).normalized()).reach().empty()); // one beside the other
}

// The bath comes over rims that are deeper than all that lies there is thick.
TEST(BathReach, WhatHasGoneUnderIsWetOnBothFaces) {
  using enum BathReach;
  const auto of = [](const std::vector<bool>& face_up, double depths, bool shut = false) {
    FloatingStack stack(face_up);
    stack.sink(depths * layer_depth);
    return of_each_layer(stack.reach(shut), stack.size);
  };
  EXPECT_EQ(of({true}, 0.9), OfLayers{});
  EXPECT_EQ(of({true}, 1.1), OfLayers{around});
  EXPECT_EQ(of({true}, 1.1, true), OfLayers{});
  EXPECT_EQ(of({true, true}, 1.9), (OfLayers{below, none}));
  EXPECT_EQ(of({true, true, true}, 3.1), (OfLayers{around, around, around}));
  EXPECT_EQ(of({true, false, true}, 3.1), (OfLayers{around, around, around}));
}

TEST(BathReach, BoatsAreDryUntilTheirRimsGoUnder) {
  using enum BathReach;
  const auto boat = [](double depth) {
    FloatingStack stack({true});
    for (Vector3& x : stack.state.positions)
      x.z() = std::hypot(x.x() - 1, 2 * (x.y() - 0.5)) > 0.8 ? 0.5 : 0;
    stack.sink(depth);
    return stack;
  };
  EXPECT_TRUE(boat(0.3).reach().empty());
  const FloatingStack sunk = boat(0.6);
  EXPECT_EQ(of_each_layer(sunk.reach(), sunk.size), OfLayers{around});
}

// A patch whose rims lie on the bottom of a boat lets nothing in; under water it is wet as the boat is.
TEST(BathReach, WhatLiesOnALayerIsNoWayIn) {
  using enum BathReach;
  FloatingStack stack({true, true});
  const auto of_first_layer = [&](std::size_t v) { return v < stack.size; };
  for (std::size_t v = 0; v < stack.state.positions.size(); ++v)
    stack.state.positions[v].z() -= 4 * layer_depth;
  std::vector<char> shut(stack.state.positions.size(), 0);
  for (std::size_t v = 0; v < shut.size(); ++v)
    shut[v] = of_first_layer(v) ? 1 : 0;
  const auto reach = bath_reach({*stack.state.mesh, stack.state.positions, stack.state.volumes, stack.springs, shut},
                                Vector3::UnitZ(), 0);
  EXPECT_EQ(of_each_layer(reach, stack.size), (OfLayers{below, none}));
}

// Of a sheet that comes down on edge what is deeper than it is thick.
TEST(BathReach, WhatHangsIntoTheBath) {
  using enum BathReach;
  FloatingStack stack({true});
  for (Vector3& x : stack.state.positions)
    x = {0, x.y(), x.x() - 1};
  const std::vector<BathReach> reach = stack.reach();
  ASSERT_FALSE(reach.empty());
  for (std::size_t v = 0; v < reach.size(); ++v)
    EXPECT_EQ(reach[v], stack.state.positions[v].z() < -layer_depth ? around : below) << v;
}

// A ball's outer face is wet, wherever it is; one with a small hole on top is a boat, until the bath is over its rim.
TEST(BathReach, WhatIsClosedIsWetOutside) {
  using enum BathReach;
  const auto of = [](bool hole, double level, double height = 1) {
    test::Mesh ball = test::icosphere(2);
    if (hole)
      std::erase_if(ball.triangles, [&](const Corners& c) {
        return std::ranges::all_of(c, [&](auto v) { return ball.positions[v].z() > 0.9; });
      });
    for (Vector3& x : ball.positions)
      x.z() *= height;
    const State s = test::at_rest(ball, 0.01);
    return bath_reach({*s.mesh, s.positions, s.volumes, {}, std::vector<char>(s.positions.size(), 0)}, Vector3::UnitZ(),
                      level);
  };
  for (const double level : {-2, 0, 2})
    EXPECT_EQ(of(false, level), OfLayers(test::icosphere(2).positions.size(), outside));
  EXPECT_EQ(of(false, 2, 0.01), OfLayers(test::icosphere(2).positions.size(), outside)); // a collapsed one
  EXPECT_EQ(std::ranges::count(of(true, 0.5), outside), std::ssize(test::icosphere(2).positions) - 1);
  EXPECT_EQ(std::ranges::count(of(true, 1), around), std::ssize(test::icosphere(2).positions) - 1);
}

Model on_bath(const FloatingStack& stack, double lower, double upper) {
  Model m;
  m.liquid = {.viscosity = 100, .density = lower};
  if (upper != lower)
    m.other_liquids = {{.viscosity = 300, .density = upper}};
  m.gravity = {0, 0, -weight_of_kg};
  m.bath = BathLiquid{.density = bath_density};
  m.contacts = stack.springs;
  m.bath_reach = stack.reach();
  m.inertia = false;
  return m;
}

// A ball is lifted by the weight of what it displaces, exactly, and not turned, nor moved aside.
TEST(BathReach, WhatIsClosedIsLiftedByItsRoom) {
  const test::Mesh ball = test::icosphere(2);
  const State start = test::at_rest(ball, 0.01);
  double room = 0;
  for (const Corners& c : ball.triangles)
    room += ball.positions[c[0]].dot(ball.positions[c[1]].cross(ball.positions[c[2]])) / 6;
  for (const double level : {3.0, 0.0}) {
    Model m;
    m.liquid = {.viscosity = 100, .density = 1};
    m.gravity = {0, 0, -weight_of_kg};
    m.bath = BathLiquid{.density = bath_density, .level = level};
    m.bath_reach.assign(start.positions.size(), BathReach::outside);
    State s = start;
    constexpr double step = 1e-7;
    Stepper(m, {}).step(s, step);
    Vector3 momentum = Vector3::Zero();
    double mass = 0;
    for (std::size_t t = 0; t < s.volumes.size(); ++t) {
      mass += s.volumes[t];
      for (const auto v : ball.triangles[t])
        momentum += s.volumes[t] / 3 * s.velocities[v];
    }
    const double lift = bath_density * weight_of_kg * (level > 1 ? room : room / 2);
    EXPECT_NEAR((momentum / step - Vector3(0, 0, lift - mass * weight_of_kg)).norm(), 0, 1e-3 * lift) << level;
  }
}

// As layer_depth as both displace of the bath, the springs between them pressed by the weight of the upper one.
TEST(BathReach, TwoLayersFloatAsDeepAsBothWeigh) {
  for (const auto& [lower, upper, face_up] :
       {std::tuple{900.0, 900.0, true}, std::tuple{900.0, 600.0, true}, std::tuple{900.0, 600.0, false}}) {
    FloatingStack stack({face_up, true});
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

// A corner of a rim that has gone under comes up to where it floats in one long step, and is not thrown out of the
// bath; what is around it stays.
TEST(BathReach, ARimThatWasUnderFloats) {
  constexpr double density = 900, depth = density * layer_depth / bath_density;
  FloatingStack stack({true});
  stack.sink(depth);
  stack.state.positions[0].z() = -1.1 * layer_depth;
  Model m = on_bath(stack, density, density);
  ASSERT_EQ(m.bath_reach[0], BathReach::around);
  Hold along;
  for (std::uint32_t v = 0; v < stack.state.positions.size(); ++v)
    along.vertices.push_back(v);
  along.axes = static_cast<Axes>(axis_bit(0) | axis_bit(1));
  m.holds = {along};
  for (const Scheme scheme : {Scheme::backward_euler, Scheme::sdirk2}) {
    State state = stack.state;
    StepOptions options;
    options.scheme = scheme;
    Stepper(m, options).step(state, 100);
    for (const Vector3& x : state.positions)
      EXPECT_NEAR(x.z(), -depth, 0.01 * depth);
  }
}

// What is heavier than the bath sinks by the weight that the bath does not take off, however it lies.
TEST(BathReach, WhatIsHeavierSinks) {
  constexpr double density = 1350, step = 0.01;
  for (const bool on_edge : {false, true}) {
    FloatingStack stack({true});
    for (Vector3& x : stack.state.positions)
      x = on_edge ? Vector3(0, x.y(), x.x() - 5) : Vector3(x.x(), x.y(), -3 * layer_depth);
    Model m = on_bath(stack, density, density);
    m.inertia = true;
    Stepper(m, {}).step(stack.state, step);
    for (const Vector3& v : stack.state.velocities)
      EXPECT_NEAR((v + Vector3(0, 0, (1 - bath_density / density) * weight_of_kg * step)).norm(), 0, 1e-9);
  }
}

// On a bath twice as dense each layer's thrust is half its own weight's: both go on as one of twice the thickness.
TEST(BathReach, TwoLayersSpreadAsOneOfTwiceTheThickness) {
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

// Held back as a plate is it falls at v, C ρ_b v²/2 = (ρ - ρ_b) g h, with the C of what lies flat or stands on edge.
TEST(BathReach, WhatSinksComesToItsSpeed) {
  constexpr double density = 1350, drag = 1.2, friction = 0.01;
  for (const auto& [on_edge, inertia] : {std::pair{false, true}, {true, true}, {false, false}, {true, false}}) {
    FloatingStack stack({true});
    if (on_edge)
      for (Vector3& x : stack.state.positions)
        x = Vector3(0, x.y(), x.x());
    stack.sink(100);
    Model m = on_bath(stack, density, density);
    m.inertia = inertia;
    m.bath_flow = OuterFlow{.density = bath_density, .drag = drag, .friction = friction};
    Stepper stepper(m, {});
    for (int i = 0; i < 100; ++i)
      stepper.step(stack.state, 0.1);
    const double held = on_edge ? friction : drag;
    const double speed = std::sqrt(2 * (density / bath_density - 1) * weight_of_kg * layer_depth / held);
    for (const Vector3& v : stack.state.velocities)
      EXPECT_NEAR((v + Vector3(0, 0, speed)).norm(), 0, 0.01 * speed) << on_edge << inertia;
  }
}

} // namespace
} // namespace sheet
