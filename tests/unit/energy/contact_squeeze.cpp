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

// Of a layer on which something far above presses with that pressure at its vertices.
Squeezed squeezed(double thickness, const std::function<double(const Vector3&)>& pressure) {
  test::Mesh mesh = test::rectangle(1, 1, squares, squares, 0);
  const auto layer = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t count = mesh.triangles.size();
  for (const Vector3& corner : {Vector3(0, 0, 1), Vector3(1, 0, 1), Vector3(0, 1, 1)})
    mesh.positions.push_back(corner);
  mesh.triangles.push_back({layer, layer + 1, layer + 2});
  const State start = test::at_rest(mesh, thickness);
  std::vector<double> around(mesh.positions.size(), 0);
  for (std::size_t t = 0; t < count; ++t)
    for (const auto v : mesh.triangles[t])
      around[v] += side * side / 2 / 3;
  std::vector<ContactSpring> springs;
  for (std::uint32_t v = 0; v < layer; ++v) {
    ContactSpring spring;
    spring.vertices = {v, layer, layer + 1, layer + 2};
    spring.weights = {1, -0.4, -0.3, -0.3};
    spring.stiffness = {pressure(mesh.positions[v]) * around[v], 0}; // 1 m shorter than at rest
    springs.push_back(spring);
  }
  const Stage stage = first_stage(start, Liquid{}, 0.1, 0.1, false);
  ContactSqueeze squeeze(std::make_shared<SpringRests>(springs, true, *start.mesh));
  squeeze.begin(stage);
  Squeezed found;
  for (std::size_t t = 0; t < count; ++t) {
    found.q.push_back(squeeze.work(t) / start.volumes[t]);
    found.areas.push_back(start.volumes[t] / thickness);
  }
  return found;
}

double whole(const Squeezed& layer) {
  double sum = 0;
  for (std::size_t t = 0; t < layer.q.size(); ++t)
    sum += layer.q[t] * layer.areas[t];
  return sum;
}

// Root of the mean square of what is beside half of mean_press.
double roughness(const Squeezed& layer) {
  double sum = 0;
  for (const double q : layer.q)
    sum += (q - mean_press / 2) * (q - mean_press / 2);
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
// vertex to vertex over a spread of s is side/(2 √π s) of it, over a triangle 1/√3. With what is around each vertex, a
// ninth of each of six neighbours, 4/9 of a square's side squared, over a triangle √93/27.
TEST(ContactSqueeze, NoiseOfVerticesIsNotFelt) {
  const auto noise = [random = std::mt19937_64(3)](const Vector3&) mutable {
    return std::uniform_real_distribution<double>(0, 2 * mean_press)(random);
  };
  const auto part = [](double spread) {
    return std::sqrt(3 / std::numbers::pi) / 2 * side / std::hypot(spread, side * 2 / 3);
  };
  const double each = mean_press / 6; // half of each vertex', over a triangle
  const double thin = std::sqrt(93.0) / 27 * std::sqrt(3.0) * each;
  EXPECT_NEAR(roughness(squeezed(0.001, noise)), thin, 0.08 * thin); // more at the border
  EXPECT_NEAR(roughness(squeezed(2 * side, noise)) / each, part(2 * side / std::sqrt(3.0)), 0.05);
  EXPECT_NEAR(roughness(squeezed(3.5 * side, noise)) / each, part(3.5 * side / std::sqrt(3.0)), 0.05);
}

} // namespace
} // namespace sheet
