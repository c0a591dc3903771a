// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of liquid that flows along walls: forces, rigid motion, corners, length of steps.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/wall_distance.h"
#include "libsheet/energy/wall_weight.h"
#include "libsheet/geometry/area.h"
#include "libsheet/solve/step.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

Wall floor_of(const State& s, double height = 0) {
  Wall wall;
  for (std::uint32_t v = 0; v < s.positions.size(); ++v)
    wall.vertices.push_back(v);
  wall.nearest = [height](double, const Vector3& x) { return WallPoint{x.z() - height, Vector3::UnitZ()}; };
  return wall;
}

State resting(double thickness) {
  State s = test::at_rest(test::rectangle(1, 1, 5, 5, 0), thickness);
  for (Vector3& x : s.positions)
    x.z() = thickness / 2;
  return s;
}

Model heavy_layer() {
  Model m;
  m.liquid.viscosity = 3;
  m.liquid.density = 2;
  m.gravity = {1.5, 0.5, -9};
  m.reactions = Reactions::of_stage;
  return m;
}

// The wall bears the weight and takes the momentum that drag takes away.
TEST(Walls, ForcesAndMomentumBalance) {
  State s = resting(0.1);
  for (std::size_t v = 0; v < s.velocities.size(); ++v)
    s.velocities[v] = {1 + 0.1 * static_cast<double>(v % 3), -0.5, 0};
  Model m = heavy_layer();
  m.walls.push_back(floor_of(s));
  StepOptions options;
  options.scheme = Scheme::backward_euler;
  options.newton.tolerance = 1e-12;
  Stepper stepper(m, options);
  const auto momentum = [&](const State& at) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t t = 0; t < at.volumes.size(); ++t)
      for (const auto v : at.mesh->triangles[t])
        sum += m.liquid.density * at.volumes[t] / 3 * at.velocities[v];
    return sum;
  };
  double mass = 0;
  for (const double v : s.volumes)
    mass += m.liquid.density * v;
  const Vector3 before = momentum(s);
  constexpr double dt = 0.01;
  const StepReport report = stepper.step(s, dt);
  ASSERT_EQ(report.substeps, 1);
  Vector3 force = Vector3::Zero();
  for (const Vector3& f : report.reactions.all)
    force += f;
  const Vector3 defect = momentum(s) - before - dt * (mass * m.gravity + force);
  EXPECT_LT(defect.norm(), 1e-10 * before.norm());
  EXPECT_NEAR(force.z(), mass * 9, 0.05 * mass * 9); // thickness changes, so it rises a little
  for (const Vector3& v : s.velocities)
    EXPECT_EQ(v.z(), 0);
}

// A layer that is warmer at its upper face by 2 a runs down a slope with the mean velocity
//   (ρ g_t h²/μ) ∫ s² exp(2 b a ζ) dζ, s the part of it beyond, seen from the wall:
// on its warm side it slides, on its cold one it hardly moves, by the same mean viscosity.
TEST(Walls, ALayerRunsWhereItIsWarm) {
  constexpr double thickness = 0.1, a = 40, b = 0.05, warm = 400, pull = 1.5;
  for (const double side : {1.0, -1.0}) { // of the wall's normal
    State s = resting(thickness);
    for (Vector3& x : s.positions)
      x.z() *= side;
    s.temperatures.assign(s.volumes.size(), warm);
    s.temperature_modes.assign(s.volumes.size(), a);
    Model m;
    m.liquid = {.viscosity = 3, .density = 2};
    m.liquid.temperature_law = {
        .kind = TemperatureLawKind::exponential, .reference_temperature = warm, .temperature_coefficient = b};
    m.heat = HeatModel{.capacity = 1e30, .conductivity = 1e-9, .profile = heat::all_modes(2)};
    m.inertia = false;
    m.gravity = {pull, 0, 0};
    m.walls.push_back(floor_of(s));
    m.walls[0].nearest = [side](double, const Vector3& x) { return WallPoint{side * x.z(), side * Vector3::UnitZ()}; };
    double integral = 0;
    constexpr int count = 1000;
    for (int k = 0; k < count; ++k) {
      const double zeta = (k + 0.5) / count - 0.5, beyond = 0.5 - side * zeta;
      integral += beyond * beyond * std::exp(2 * b * a * zeta) / count;
    }
    Stepper stepper(m, {});
    (void)stepper.step(s, 1e-3);
    const double exact = 2 * pull * thickness * thickness / 3 * integral;
    for (const Vector3& v : s.velocities)
      EXPECT_NEAR(v.x(), exact, 1e-4 * exact) << side;
  }
}

// Wall and layer turn together, far and fast, without inertia: nothing is spent.
TEST(Walls, RigidTurnCostsNothing) {
  State s = resting(0.1);
  Model m;
  m.liquid.viscosity = 3;
  m.inertia = false;
  m.walls.push_back(floor_of(s));
  const Vector3 axis = Vector3(0.2, -0.3, 1).normalized();
  constexpr double rate = 2;
  const auto turned = [=](double from, double to) -> Matrix3 {
    return Eigen::AngleAxisd(rate * (to - from), axis).toRotationMatrix();
  };
  m.walls[0].motion = [=](double from, double to) { return RigidMotion{turned(from, to), Vector3::Zero()}; };
  m.walls[0].velocity = [=](double, const Vector3& x) { return Vector3(rate * axis.cross(x)); };
  m.walls[0].nearest = [=](double t, const Vector3& x) {
    const Vector3 n = turned(0, t) * Vector3::UnitZ();
    return WallPoint{n.dot(x), n};
  };
  for (std::size_t v = 0; v < s.velocities.size(); ++v)
    s.velocities[v] = rate * axis.cross(s.positions[v]);
  const State start = s;
  StepOptions options;
  options.newton.tolerance = 1e-13;
  Stepper stepper(m, options);
  for (int k = 0; k < 20; ++k)
    (void)stepper.step(s, 0.02);
  const Matrix3 turn = turned(0, s.time);
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    EXPECT_LT((s.positions[v] - turn * start.positions[v]).norm(), 1e-12);
}

// A layer on a wall and one on it, half as thick, each vertex above another one, with the springs that sheet-collide
// would make.
struct Stack {
  State state;
  Model model;
  std::size_t upper; // its first vertex
};

Stack stack(double lower, double upper) {
  test::Mesh mesh = test::rectangle(1, 1, 4, 4, 0), above = mesh;
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t triangles = mesh.triangles.size();
  for (Vector3& x : mesh.positions)
    x.z() = lower / 2;
  for (Vector3 x : above.positions)
    mesh.positions.emplace_back(x.x(), x.y(), lower + upper / 2);
  for (const Corners& t : above.triangles)
    mesh.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  Stack s{test::at_rest(mesh, lower), heavy_layer(), n};
  for (std::size_t t = triangles; t < 2 * triangles; ++t)
    s.state.volumes[t] *= upper / lower;
  Wall wall = floor_of(s.state);
  wall.vertices.resize(n);
  s.model.walls.push_back(wall);
  std::vector<char> seen(n, 0);
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [a, b, d] =
          std::array{mesh.triangles[t][c], mesh.triangles[t][(c + 1) % 3], mesh.triangles[t][(c + 2) % 3]};
      if (std::exchange(seen[a], 1) != 0)
        continue;
      for (const bool up : {true, false}) {
        ContactSpring spring;
        spring.vertices = up ? std::array{a + n, a, b, d} : std::array{a, a + n, b + n, d + n};
        spring.weights = {1, -1, 0, 0};
        spring.rest = (lower + upper) / 2;
        spring.normal = spring.anchor = Vector3(0, 0, up ? 1 : -1);
        spring.anchor *= spring.rest;
        spring.stiffness = {1e3, 0};
        s.model.contacts.push_back(spring);
      }
    }
  s.model.contacts_flow = true;
  return s;
}

// Two layers run down an incline as one does of their thickness together: the means of its parabola below and above.
TEST(Walls, StackedLayersShareAParabola) {
  for (const double slip : {0.0, 0.02}) {
    constexpr double lower = 0.1, upper = 0.05;
    Stack s = stack(lower, upper);
    s.model.inertia = false;
    s.model.gravity = {1.5, 0, 0};
    s.model.walls[0].slip_length = slip;
    StepOptions options;
    options.newton.tolerance = 1e-12;
    Stepper stepper(s.model, options);
    const StepReport report = stepper.step(s.state, 1e-3);
    const double force = s.model.liquid.density * 1.5, height = lower + upper;
    const auto volume = [&](double z) { // flux below z
      return force / s.model.liquid.viscosity * (slip * height * z + height * z * z / 2 - z * z * z / 6);
    };
    for (std::size_t v = 0; v < s.upper; ++v) {
      EXPECT_NEAR(s.state.velocities[v].x(), volume(lower) / lower, 1e-9 * force);
      EXPECT_NEAR(s.state.velocities[v + s.upper].x(), (volume(height) - volume(lower)) / upper, 1e-9 * force);
    }
    Vector3 taken = Vector3::Zero();
    for (const Vector3& f : report.reactions.all)
      taken += f;
    EXPECT_NEAR(taken.x(), -force * height, 1e-9 * force); // of one square metre
  }
}

// The same of two liquids, of which each has a parabola of its own: at the face between them velocity and stress are
// one.
TEST(Walls, LayersOfTwoLiquidsRunDown) {
  constexpr double lower = 0.1, upper = 0.05, slope = 1.5;
  for (const double slip : {0.0, 0.02})
    for (const double above : {0.01, 20.0}) { // its viscosity, over that below
      Stack s = stack(lower, upper);
      const Liquid& liquid = s.model.liquid;
      const Liquid other{.viscosity = above * liquid.viscosity, .density = 1.5 * liquid.density};
      s.model.other_liquids = {other};
      s.state.liquids.assign(s.state.volumes.size(), 0);
      std::fill(s.state.liquids.begin() + static_cast<std::ptrdiff_t>(s.state.volumes.size() / 2),
                s.state.liquids.end(), 1);
      s.model.inertia = false;
      s.model.gravity = {slope, 0, 0};
      s.model.walls[0].slip_length = slip;
      StepOptions options;
      options.newton.tolerance = 1e-12;
      Stepper stepper(s.model, options);
      (void)stepper.step(s.state, 1e-3);
      const double weight = slope * liquid.density, wall = weight * lower + slope * other.density * upper;
      const double mean = (wall * (slip + lower / 2) - weight * lower * lower / 6) / liquid.viscosity;
      const double face = (wall * (slip + lower) - weight * lower * lower / 2) / liquid.viscosity;
      const double mean_above = face + slope * other.density * upper * upper / (3 * other.viscosity);
      for (std::size_t v = 0; v < s.upper; ++v) {
        EXPECT_NEAR(s.state.velocities[v].x(), mean, 1e-8 * mean);
        EXPECT_NEAR(s.state.velocities[v + s.upper].x(), mean_above, 1e-8 * mean_above);
      }
    }
}

// What lies on a layer presses it out from under it. Without drag of the wall both spread as one layer of their
// thickness together would, by the mean of their rates ρ g h/(12 μ) each way; shear lets the lower one go ahead only
// near the rim.
TEST(Walls, LayersFeelTheWeightAbove) {
  constexpr double thickness = 0.1, dt = 1e-4;
  Stack s = stack(thickness, thickness);
  s.model.inertia = false;
  s.model.gravity = {0, 0, -9};
  s.model.walls[0].slip_length = free_slip;
  const auto area = [&](bool upper) {
    const std::size_t half = s.state.volumes.size() / 2;
    double sum = 0;
    for (std::size_t t = upper ? half : 0; t < (upper ? 2 : 1) * half; ++t) {
      const Corners& c = s.state.mesh->triangles[t];
      sum += TriangleArea(s.state.positions[c[0]], s.state.positions[c[1]], s.state.positions[c[2]]).area;
    }
    return sum;
  };
  std::vector<double> around(2 * s.upper, 0);
  for (std::size_t t = 0; t < s.state.volumes.size(); ++t)
    for (const auto v : s.state.mesh->triangles[t])
      around[v] += s.state.volumes[t] / 3;
  for (ContactSpring& spring : s.model.contacts) // two at a vertex, which bear the weight
    spring.rest += s.model.liquid.density * around[spring.vertices[0]] * 9 / (2 * spring.stiffness[0]);
  Stepper stepper(s.model, {});
  const double lower = area(false), upper = area(true);
  (void)stepper.step(s.state, dt);
  const double rate = 2 * s.model.liquid.density * 9 * (2 * thickness) / (12 * s.model.liquid.viscosity);
  const double lower_rate = (area(false) / lower - 1) / dt, upper_rate = (area(true) / upper - 1) / dt;
  EXPECT_NEAR((lower_rate + upper_rate) / 2, rate, 0.01 * rate);
  EXPECT_GT(lower_rate, upper_rate);
  EXPECT_LT(lower_rate, 1.3 * upper_rate);
}

// Between two walls what touches both keeps to their line.
TEST(Walls, ACornerHoldsALine) {
  State s = resting(0.1);
  Model m = heavy_layer();
  m.inertia = false;
  m.walls.push_back(floor_of(s));
  Wall side; // x <= 1 - 0.05: the sheet's end touches it
  side.nearest = [](double, const Vector3& x) { return WallPoint{1.05 - x.x(), -Vector3::UnitX()}; };
  m.walls.push_back(side);
  Stepper stepper(m, {});
  for (int k = 0; k < 5; ++k)
    (void)stepper.step(s, 0.01);
  double furthest = 0;
  for (const Vector3& x : s.positions)
    furthest = std::max(furthest, x.x());
  EXPECT_LT(furthest, 1 + 2e-4); // though nothing touches the side yet: as near as the layer is thin by then
  EXPECT_GT(furthest, 0.98);
}

// What a side holds lies on its floor half as high as it is thick, like all else: a layer that a gate dams up sinks
// with the rest, or it would be farther from its floor than it is thick one day, and touch it no more; and what a
// plough piles up rises with the rest, or what is before it would slope down to it, steeper than what lies may.
TEST(Walls, WhatStandsBesideASideSinksAndRisesWithTheRest) {
  for (const double part : {0.5, 1.5}) { // of the thickness as which it begins
    State s = resting(0.1);
    for (double& volume : s.volumes)
      volume *= part;
    Model m = heavy_layer();
    m.inertia = false;
    m.gravity = {1.5, 0, -9};
    m.walls.push_back(floor_of(s));
    Wall side;
    side.nearest = [](double, const Vector3& x) { return WallPoint{1.03 - x.x(), -Vector3::UnitX()}; };
    m.walls.push_back(side);
    Stepper stepper(m, {});
    for (int k = 0; k < 5; ++k)
      (void)stepper.step(s, 0.001);
    for (const Vector3& x : s.positions)
      EXPECT_NEAR(x.z(), 0.05 * part, 1e-3);
  }
}

// A layer on the floor of a dish, whose rim stands beside the dish's side and is nearer to that: floor and side are one
// wall, or two. What is borne there is borne by the floor, or the layer would be thicker along the side for good.
// Beside one wall its rim keeps its distance, and does not give way to half a thickness from the side.
TEST(Walls, ALayerStandsBesideTheSideOfItsDish) {
  constexpr double thickness = 0.1, off = 0.03; // of the rim from the side
  const State s = resting(thickness);
  const auto by_the_side = [](const Vector3& x) { return x.x() > 1 - 1e-9; };
  const WallPoint side{off, -Vector3::UnitX()};
  Wall dish = floor_of(s), one = dish, other = dish;
  dish.nearest = [&](double, const Vector3& x) { return by_the_side(x) ? side : WallPoint{x.z(), Vector3::UnitZ()}; };
  other.nearest = [](double, const Vector3& x) { return WallPoint{1 + off - x.x(), -Vector3::UnitX()}; };
  std::erase_if(one.vertices, [&](std::uint32_t v) { return by_the_side(s.positions[v]); });
  std::erase_if(other.vertices, [&](std::uint32_t v) { return !by_the_side(s.positions[v]); });
  const auto begun = [&](const std::vector<Wall>& walls) {
    Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
    set_wall_sites(walls, stage);
    return stage;
  };
  WallWeight weight(Vector3(0, 0, -9));
  for (const std::vector<Wall>& walls : {std::vector{dish}, {one, other}}) {
    const Stage stage = begun(walls);
    weight.begin(stage);
    for (std::size_t t = 0; t < weight.size(); ++t)
      EXPECT_NEAR(weight.thrust(t), 2 * 9 * s.volumes[t] * s.volumes[t] / 2, 1e-15);
  }
  const std::vector<double> lying = lying_thickness(begun({dish}), s);
  for (std::size_t v = 0; v < lying.size(); ++v)
    EXPECT_NEAR(lying[v], by_the_side(s.positions[v]) ? 0 : thickness, 1e-12);
}

// One that nothing touches holds what comes near it beside another wall: as a dish's side does, which stands still with
// its floor, and what stands on the floor and comes along it, as a plough, or slides past, not what moves away. What
// comes with a gap below it does not: what it comes to passes below it.
TEST(Walls, WhatNothingTouchesHoldsAsASideOrAPlough) {
  const State s = resting(0.1);
  const auto held_by = [&](double begins, const Vector3& velocity) { // how high over the floor; its velocity
    Wall wall;
    wall.velocity = [=](double, const Vector3&) { return velocity; };
    wall.nearest = [=](double, const Vector3& x) {
      const Vector3 way(1.03 - x.x(), 0, std::max(begins - x.z(), 0.0));
      return WallPoint{way.norm(), -way.normalized()};
    };
    Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
    set_wall_sites({floor_of(s), wall}, stage);
    return std::ranges::count_if(stage.sites, [](const WallSite& site) { return site.across.size() > 1; });
  };
  EXPECT_EQ(held_by(0, {0, 0, 0}), 6);
  EXPECT_EQ(held_by(0, {-0.1, 0, 0}), 6);
  EXPECT_EQ(held_by(0, {0, 0.1, 0}), 6);
  EXPECT_EQ(held_by(0, {0.1, 0, 0}), 0);
  EXPECT_EQ(held_by(0.04, {-0.1, 0, 0}), 0);
}

// A hollow wall's corner holds a line, as that of two walls does: of its faces that beside the nearest one, too.
TEST(Walls, ACornerOfOneWallHoldsALine) {
  constexpr double thickness = 0.1;
  const State s = resting(thickness);
  for (const double off : {0.03, 0.06}) { // of the rim from the side, which is nearer than the floor or farther off
    Wall dish = floor_of(s);
    dish.nearest = [&](double, const Vector3& x) {
      const double aside = 1 + off - x.x();
      return aside < x.z() ? WallPoint{aside, -Vector3::UnitX()} : WallPoint{x.z(), Vector3::UnitZ()};
    };
    for (const bool hollow : {false, true}) {
      dish.hollow = hollow;
      Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
      set_wall_sites({dish}, stage);
      for (const WallSite& site : stage.sites) {
        const bool corner = s.positions[site.vertex].x() > 1 - 1e-9;
        ASSERT_EQ(site.across.size(), hollow && corner && off < thickness / 2 ? 2 : 1);
        if (site.across.size() == 2) {
          EXPECT_NEAR((site.across[1] - Vector3::UnitZ()).norm(), 0, 1e-12);
          EXPECT_NEAR(site.place[1], thickness / 2, 1e-12);
        }
      }
    }
  }
}

// A wall lets go of what touches another one and would have to be pulled: what comes to rest in a corner flows on when
// its weight points elsewhere. Pressed into the corner, or where forces are not known, it keeps to the line.
TEST(Walls, ACornerLetsGoWhereItWouldPull) {
  for (const double force : {-1.0, 1.0}) {
    State s = resting(0.1);
    Model m = heavy_layer();
    m.inertia = false;
    m.gravity.x() = -20; // away from the side
    m.walls.push_back(floor_of(s));
    m.walls[0].forces.assign(s.positions.size(), Vector3(-force, 0, 1));
    Wall side;
    side.vertices = {0};
    side.nearest = [](double, const Vector3& x) { return WallPoint{1.05 - x.x(), -Vector3::UnitX()}; };
    std::erase(m.walls[0].vertices, 0U);
    m.walls[0].forces.pop_back();
    m.walls.push_back(side);
    Stepper stepper(m, {});
    (void)stepper.step(s, 0.01);
    double furthest = 0;
    for (const Vector3& x : s.positions)
      furthest = std::max(furthest, x.x());
    if (force < 0) {
      EXPECT_LT(furthest, 1 - 1e-5);
    } else {
      EXPECT_NEAR(furthest, 1, 1e-12);
    }
  }
}

// In a gap that has just been found, as beside a tool that came down, a layer may lie farther from its wall than it may
// be there: it comes nearer at ten times the rate at which the walls close, and is not thrown in a short step. Where
// they part, as under a gate that is lifted, they press nothing out: they slide past each other at most.
TEST(Walls, WhatIsTooFarFromItsWallInAGapComesNearerInTime) {
  const double lid_at = 0.06, speed = 0.01;
  const auto expect_rate = [&](const Vector3& velocity, double rate) {
    for (const double duration : {1e-6, 0.01, 1.0}) {
      const State s = resting(0.1);
      Wall lid;
      lid.nearest = [&](double, const Vector3& x) { return WallPoint{lid_at - x.z(), -Vector3::UnitZ()}; };
      lid.velocity = [&](double, const Vector3&) { return velocity; };
      Stage stage = first_stage(s, heavy_layer().liquid, duration, duration, true);
      set_wall_sites({floor_of(s), lid}, stage);
      ASSERT_EQ(stage.channels.size(), s.positions.size());
      EXPECT_NEAR(stage.channel_rate, rate, 1e-12);
      for (const WallSite& site : stage.sites)
        EXPECT_NEAR(site.place[0], std::max(0.75 * lid_at, 0.05 / (1 + rate * duration)), 1e-12);
    }
  };
  expect_rate({0, 0, -speed}, 10 * (speed / lid_at + speed)); // the layer's area is 1
  expect_rate({0, 0, speed}, 0);
  expect_rate({speed, 0, speed}, 10 * speed);
}

// Where a wall begins to face another one all at once, as beyond an edge of a box, a gap is there at once, and was as
// narrow before but for what the vertex has moved: what is too thick for it gives way in time, not in one step.
TEST(Walls, AGapThatIsFoundHasNotNarrowedByMoreThanWhatMoves) {
  constexpr double lid_at = 0.08, speed = 1e-3, duration = 0.01, moved = speed * duration;
  State s = resting(0.1);
  s.velocities.assign(s.positions.size(), Vector3(speed, 0, 0));
  Wall lid;
  lid.nearest = [&](double, const Vector3& x) {
    const bool faces = x.x() > 0.4 + moved / 2; // a row of vertices comes there
    return WallPoint{lid_at - x.z(), faces ? Vector3(-Vector3::UnitZ()) : Vector3::UnitX()};
  };
  Stage stage = first_stage(s, heavy_layer().liquid, duration, duration, true);
  set_wall_sites({floor_of(s), lid}, stage);
  ASSERT_FALSE(stage.channels.empty());
  bool comes = false;
  for (const Channel& channel : stage.channels) {
    EXPECT_NEAR(channel.gap, lid_at, 1e-12);
    EXPECT_LT(channel.gap_before, lid_at + 4 * moved);
    comes = comes || std::abs(s.positions[channel.vertex].x() - 0.4) < moved;
  }
  EXPECT_TRUE(comes);
}

// Of two tools over a layer, each a strip of 1 by 0.3 with its rim, not of both.
TEST(Walls, EachRegionBetweenWallsHasItsHydraulicDiameter) {
  const State s = resting(0.1);
  Wall tools;
  tools.nearest = [](double, const Vector3& x) {
    const bool faces = x.x() < 0.3 || x.x() > 0.7;
    return WallPoint{0.08 - x.z(), faces ? Vector3(-Vector3::UnitZ()) : Vector3::UnitX()};
  };
  Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
  set_wall_sites({floor_of(s), tools}, stage);
  EXPECT_EQ(stage.channels.size(), 24);
  for (const Channel& channel : stage.channels)
    EXPECT_NEAR(channel.diameter, 4 * 0.3 / 2.6, 1e-12);
}

// A fixed step in which liquid would pass edges is taken in parts.
TEST(Walls, StepsPassHalfAnEdgeAtMost) {
  State s = resting(0.1);
  Model m = heavy_layer();
  m.walls.push_back(floor_of(s));
  m.walls[0].slip_length = free_slip; // or it stops at once
  for (Vector3& v : s.velocities)
    v = {10, 0, 0};
  Stepper stepper(m, {});
  EXPECT_GE(stepper.step(s, 0.1).substeps, 8); // edges of 0.2 and their diagonals
  EXPECT_DOUBLE_EQ(s.time, 0.1);
}

// Directors follow the normals of a layer, but not where it is folded back on itself within the wall's plane: the mean
// of the normals there turns over at once as the fold passes 180 degrees.
TEST(Walls, DirectorsOfFlatFoldsAreFree) {
  State s = resting(0.1);
  const auto folded = [](const Vector3& x) { return std::abs(x.x() - 0.6) < 1e-9; };
  std::vector<char> at_fold;
  for (const Edge& edge : s.mesh->edges)
    at_fold.push_back(folded(s.positions[edge[0]]) && folded(s.positions[edge[1]]) ? 1 : 0);
  for (Vector3& x : s.positions)
    x.x() = std::min(x.x(), 1.2 - x.x());
  Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
  set_wall_sites({floor_of(s)}, stage);
  EXPECT_EQ(std::ranges::count(at_fold, 1), 5);
  for (std::uint32_t e = 0; e < at_fold.size(); ++e)
    EXPECT_NE(std::ranges::binary_search(stage.wall_edges, e), at_fold[e] != 0);
}

// Cells of 0.2 have edges of 0.283 at most.
TEST(Walls, WhatIsCrushedBendsAsThickAsItIsLong) {
  for (const double thickness : {0.28, 0.6}) {
    State s = resting(thickness);
    Stage stage = first_stage(s, heavy_layer().liquid, 0.01, 0.01, true);
    set_wall_sites({floor_of(s)}, stage);
    for (std::size_t t = 0; t < s.volumes.size(); ++t)
      EXPECT_NEAR(stage.bending(t), std::min(1.0, 0.08 / (thickness * thickness)), 1e-12);
    EXPECT_EQ(stage.wall_bending.empty(), thickness < 0.28284);
    Wall far_away = floor_of(s);
    far_away.vertices.clear();
    set_wall_sites({far_away}, stage);
    EXPECT_EQ(stage.bending(0), 1);
  }
}

// Root mean square of the differences of thickness from triangle to triangle [m].
double roughness(const State& s) {
  std::vector<double> thickness;
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Corners& c = s.mesh->triangles[t];
    thickness.push_back(s.volumes[t] / TriangleArea(s.positions[c[0]], s.positions[c[1]], s.positions[c[2]]).area);
  }
  double sum = 0, count = 0;
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    if (!s.mesh->on_rim(e)) {
      const auto [one, other] = s.mesh->edge_triangles[e];
      sum += (thickness[one] - thickness[other]) * (thickness[one] - thickness[other]);
      ++count;
    }
  return std::sqrt(sum / count);
}

// Patterns of an edge's length level within l²/(π² D) = 16 s, D = g h³/(3 ν), those of twice that within 64 s. The rim
// is held, so the layer does not spread.
TEST(Walls, RandomThicknessLevels) {
  State s = resting(0.05);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0.9, 1.1);
  for (double& v : s.volumes)
    v *= part(random);
  const double before = roughness(s);
  Model m = heavy_layer();
  m.gravity = {0, 0, -9};
  m.walls.push_back(floor_of(s));
  Hold rim;
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    if (s.mesh->on_rim(e))
      rim.vertices.push_back(s.mesh->edges[e][0]), rim.vertices.push_back(s.mesh->edges[e][1]);
  m.holds.push_back(rim);
  Stepper stepper(m, {});
  const double volume = std::accumulate(s.volumes.begin(), s.volumes.end(), 0.0);
  for (int k = 0; k < 60; ++k)
    ASSERT_EQ(stepper.step(s, 4).unfinished, 0);
  EXPECT_LT(roughness(s), 0.1 * before);
  EXPECT_NEAR(std::accumulate(s.volumes.begin(), s.volumes.end(), 0.0), volume, 1e-14 * volume);
}

} // namespace
} // namespace sheet
