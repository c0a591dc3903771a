// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/contact_squeeze.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/energy/stage_setup.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr int squares = 40;            // along each side of a layer, 1 m wide
constexpr double side = 1.0 / squares; // of a square [m]
constexpr double mean_press = 100;     // [Pa]

struct Squeezed {
  std::vector<double> q, areas; // of the layer's triangles [Pa], [m²]
};

// A level layer, and two triangles far above and below it that press with these pressures at its vertices [Pa].
struct Pressed {
  State start;
  std::size_t count; // of its triangles
  std::vector<ContactSpring> springs;

  using Pressure = std::function<double(const Vector3&)>;
  Pressed(double thickness, const Pressure& above, const Pressure& below, const Vector3& tilt = Vector3::UnitZ())
      : start(layers(thickness, tilt)), count(start.mesh->triangles.size() - 2) {
    const std::size_t layer = start.mesh->vertices - 6;
    std::vector<double> around(layer, 0);
    for (std::size_t t = 0; t < count; ++t)
      for (const auto v : start.mesh->triangles[t])
        around[v] += side * side / 2 / 3;
    for (std::uint32_t v = 0; v < layer; ++v)
      for (const bool top : {true, false}) {
        const Corners& far = start.mesh->triangles[count + (top ? 0 : 1)];
        ContactSpring spring;
        spring.vertices = {v, far[0], far[1], far[2]};
        spring.weights = {1, -0.4, -0.3, -0.3};
        spring.normal = top ? Vector3(-tilt) : tilt;
        spring.rest = spring.normal.dot(spring.offset(start.positions)) + 1; // 1 m shorter than at rest
        spring.stiffness = {(top ? above : below)(start.positions[v]) * around[v], 0};
        springs.push_back(spring);
      }
  }

  static State layers(double thickness, const Vector3& tilt) {
    test::Mesh mesh = test::rectangle(1, 1, squares, squares, 0);
    for (const double z : {1, -1}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Vector3& corner : {Vector3(0, 0, z), Vector3(1, 0, z), Vector3(0, 1, z)})
        mesh.positions.push_back(corner);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const auto turn = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), tilt);
    for (Vector3& x : mesh.positions)
      x = turn * x;
    return test::at_rest(mesh, thickness);
  }
};

// Where the same presses from both sides.
Squeezed squeezed(double thickness, const Pressed::Pressure& pressure) {
  std::vector<double> once; // noise is the same on both sides
  std::size_t next = 0;
  const Pressed layer(
      thickness, [&](const Vector3& x) { return once.emplace_back(pressure(x)); },
      [&](const Vector3&) { return once[next++]; });
  const Stage stage = first_stage(layer.start, Liquid{}, 0.1, 0.1, false);
  ContactSqueeze squeeze(layer.springs, Vector3::Zero());
  squeeze.begin(stage);
  Squeezed found;
  for (std::size_t t = 0; t < layer.count; ++t) {
    EXPECT_EQ(squeeze.thrust(t), 0);
    found.q.push_back(squeeze.work(t) / layer.start.volumes[t]);
    found.areas.push_back(layer.start.volumes[t] / thickness);
  }
  return found;
}

double whole(const Squeezed& layer) {
  double sum = 0;
  for (std::size_t t = 0; t < layer.q.size(); ++t)
    sum += layer.q[t] * layer.areas[t];
  return sum;
}

// Root of the mean square of what is beside mean_press.
double roughness(const Squeezed& layer) {
  double sum = 0;
  for (const double q : layer.q)
    sum += (q - mean_press) * (q - mean_press);
  return std::sqrt(sum / static_cast<double>(layer.q.size()));
}

TEST(ContactSqueeze, EvenPressureStays) {
  for (const double thickness : {0.001, 0.1})
    EXPECT_NEAR(roughness(squeezed(thickness, [](const Vector3&) { return mean_press; })), 0, 1e-9 * mean_press);
}

// A wave of k h = 1.01 presses with 1 - k² h²/6 of it, and higher powers; all of the pressure stays. A pass spreads by
// 4/9 of a square's side, squared, along the sides of right-angled triangles, by 4/(3 √3) of half of that in the mean.
TEST(ContactSqueeze, AWaveIsFeltLessInAThickLayer) {
  constexpr double k = 2 * std::numbers::pi / 0.5, h = 0.08;
  const auto wave = [](const Vector3& x) { return mean_press * (1 + 0.5 * std::cos(k * x.x())); };
  const Squeezed thin = squeezed(0.001, wave), thick = squeezed(h, wave);
  const double along_sides = (4.0 / 9) / (2 / (3 * std::sqrt(3.0)));
  EXPECT_NEAR(roughness(thick) / roughness(thin), std::exp(-k * k * h * h / 6 * along_sides), 0.005);
  EXPECT_NEAR(whole(thick), whole(thin), 1e-9 * whole(thin));
}

// A layer thinner than half an edge feels pressures as they are.
TEST(ContactSqueeze, AThinLayerFeelsWhatPresses) {
  const auto wave = [](const Vector3& x) { return mean_press * (1 + 0.5 * std::cos(4 * std::numbers::pi * x.x())); };
  EXPECT_NEAR(roughness(squeezed(0.5 * side, wave)) / roughness(squeezed(0.001, wave)), 1, 1e-9);
  EXPECT_LT(roughness(squeezed(0.8 * side, wave)) / roughness(squeezed(0.001, wave)), 0.999);
}

// What lands vertex by vertex does not drive a layer thicker than its edges asunder. The mean of what differs from
// vertex to vertex over a spread of s is side/(2 √π s) of it, over a triangle 1/√3.
TEST(ContactSqueeze, NoiseOfVerticesIsNotFelt) {
  const auto noise = [random = std::mt19937_64(3)](const Vector3&) mutable {
    return std::uniform_real_distribution<double>(0, 2 * mean_press)(random);
  };
  const auto part = [](double spread) { return std::sqrt(3 / std::numbers::pi) / 2 * side / spread; };
  const double thin = roughness(squeezed(0.001, noise));
  EXPECT_NEAR(thin, mean_press / 3, 0.05 * mean_press / 3);
  EXPECT_NEAR(roughness(squeezed(2 * side, noise)) / thin, part(2 * side / std::sqrt(3.0)), 0.05);
  EXPECT_NEAR(roughness(squeezed(10 * side, noise)) / thin, part(4 * side * 2 / 3), 0.05); // no more than 16 passes
}

// What lies on something has the thrust of its own weight, as on a wall, however unevenly it is borne; what presses on
// one side alone squeezes nothing; what is in part borne has that part.
TEST(ContactSqueeze, WhatLiesOnALayerHasItsOwnWeight) {
  constexpr double density = 1000, h = 0.02;
  const Vector3 gravity(0, 0, -10);
  const auto thrusts = [&](const Pressed::Pressure& below, const Vector3& tilt) {
    const Pressed layer(
        h, [](const Vector3&) { return 0; }, below, tilt);
    Liquid liquid;
    liquid.density = density;
    const Stage stage = first_stage(layer.start, liquid, 0.1, 0.1, false);
    ContactSqueeze squeeze(layer.springs, gravity);
    squeeze.begin(stage);
    double least = 1e300, most = 0; // over ρ V²/2
    for (std::size_t t = 0; t < layer.count; ++t) {
      const double of = squeeze.thrust(t) / (density * layer.start.volumes[t] * layer.start.volumes[t] / 2);
      least = std::min(least, of);
      most = std::max(most, of);
      EXPECT_EQ(squeeze.work(t), 0);
    }
    return std::pair(least, most);
  };
  const double weight = density * 10 * h; // [Pa]
  const auto noise = [&, random = std::mt19937_64(3)](const Vector3&) mutable {
    return weight * (1.5 + std::uniform_real_distribution<double>(-0.5, 0.5)(random));
  };
  const auto even = [&](double part) { return [=](const Vector3&) { return part * weight; }; };
  EXPECT_EQ(thrusts(even(0), Vector3::UnitZ()), std::pair(0.0, 0.0));
  EXPECT_NEAR(thrusts(even(0.5), Vector3::UnitZ()).first, 5, 1e-9);
  EXPECT_NEAR(thrusts(even(0.5), Vector3::UnitZ()).second, 5, 1e-9);
  EXPECT_NEAR(thrusts(noise, Vector3::UnitZ()).first, 10, 1e-9);
  EXPECT_NEAR(thrusts(noise, Vector3::UnitZ()).second, 10, 1e-9);
  const Vector3 tilt = Vector3(0.6, 0, 0.8);
  EXPECT_NEAR(thrusts(even(3), tilt).first, 8, 1e-9); // the part of gravity across it
  EXPECT_NEAR(thrusts(even(3), tilt).second, 8, 1e-9);
}

} // namespace
} // namespace sheet
