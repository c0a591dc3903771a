// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "libsheet/energy/levelling.h"
#include "libsheet/energy/walls.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double thickness = 0.05;

State uneven() {
  State s = test::at_rest(test::rectangle(1, 1, 10, 10, 0), thickness);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0.9, 1.1);
  for (double& v : s.volumes)
    v *= part(random);
  for (Vector3& x : s.positions)
    x.z() = thickness / 2;
  return s;
}

Stage on_floor(const State& s) {
  Stage stage;
  stage.start = &s;
  stage.liquids[0].liquid = {3, 2, 0};
  stage.viscosity.assign(s.volumes.size(), 3);
  stage.site_of.assign(s.positions.size(), no_index);
  for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
    WallSite site;
    site.vertex = v;
    site.normal = Vector3::UnitZ();
    site.stuck = site.carried = s.positions[v];
    stage.site_of[v] = v;
    stage.sites.push_back(site);
  }
  return stage;
}

Vector3 momentum(const State& s) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t t = 0; t < s.volumes.size(); ++t)
    for (const auto v : s.mesh->triangles[t])
      sum += s.volumes[t] / 3 * s.velocities[v];
  return sum;
}

// Mean square of the differences of volume across edges.
double roughness(const State& s) {
  double sum = 0;
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    if (!s.mesh->on_rim(e)) {
      const auto [one, other] = s.mesh->edge_triangles[e];
      sum += (s.volumes[one] - s.volumes[other]) * (s.volumes[one] - s.volumes[other]);
    }
  return sum;
}

TEST(Levelling, KeepsVolumeAndMomentumAndMakesNoNewExtremes) {
  State s = uneven();
  for (std::size_t v = 0; v < s.velocities.size(); ++v)
    s.velocities[v] = {1 + 0.1 * static_cast<double>(v % 3), -0.5, 0};
  const State before = s;
  const auto [least, most] = std::ranges::minmax(before.volumes);
  ASSERT_TRUE(level_layers(on_floor(before), {0, 0, -9}, {}, false, 1e6, s));
  const auto [low, high] = std::ranges::minmax(s.volumes);
  EXPECT_GE(low, least);
  EXPECT_LE(high, most);
  EXPECT_LT(roughness(s), 0.8 * roughness(before));
  EXPECT_LT((momentum(s) - momentum(before)).norm(), 1e-14 * momentum(before).norm());
}

// A thickness that goes evenly is left to the flow: order is kept.
TEST(Levelling, LeavesEvenSlopesAlone) {
  State s = test::at_rest(test::rectangle(1, 1, 10, 10, 0), thickness);
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Corners& c = s.mesh->triangles[t];
    s.volumes[t] *= 1 + 0.5 * (s.positions[c[0]].x() + s.positions[c[1]].x() + s.positions[c[2]].x()) / 3;
  }
  const State before = s;
  ASSERT_TRUE(level_layers(on_floor(before), {0, 0, -9}, {}, false, 1e6, s));
  double away_from_rim = 0;
  for (std::size_t t = 0; t < s.volumes.size(); ++t) {
    const Vector3& x = s.positions[s.mesh->triangles[t][0]];
    if (std::abs(x.x() - 0.5) < 0.25 && std::abs(x.y() - 0.5) < 0.25)
      away_from_rim = std::max(away_from_rim, std::abs(s.volumes[t] / before.volumes[t] - 1));
  }
  EXPECT_LT(away_from_rim, 1e-3);
}

// The unit square in 20 x 20 cells, all cut alike.
State lattice() {
  constexpr std::uint32_t n = 20;
  test::Mesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      mesh.positions.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n, 0);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, c = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, c + 1}, {a, c + 1, c}});
    }
  return test::at_rest(mesh, thickness);
}

// A smooth wave is the slopes' own, where tension sees them; patterns of single triangles level all the same.
TEST(Levelling, LeavesWavesToSlopes) {
  const auto moved = [](const State& start, bool sloped) {
    State s = start;
    Stage stage = on_floor(start);
    stage.liquids[0].liquid.surface_tension = 0.1;
    EXPECT_TRUE(level_layers(stage, Vector3::Zero(), {}, sloped, 1e-3, s));
    double sum = 0;
    for (std::size_t t = 0; t < s.volumes.size(); ++t)
      if (const Vector3& x = s.positions[s.mesh->triangles[t][0]];
          std::abs(x.x() - 0.5) < 0.3 && std::abs(x.y() - 0.5) < 0.3) // away from the rim
        sum += std::abs(s.volumes[t] - start.volumes[t]);
    return sum;
  };
  State wave = lattice();
  for (std::size_t t = 0; t < wave.volumes.size(); ++t) {
    const Corners& c = wave.mesh->triangles[t];
    const double x = (wave.positions[c[0]].x() + wave.positions[c[1]].x() + wave.positions[c[2]].x()) / 3;
    wave.volumes[t] *= 1 + 0.1 * std::cos(2 * std::numbers::pi * x);
  }
  EXPECT_LT(moved(wave, true), 0.2 * moved(wave, false));
  EXPECT_GT(moved(uneven(), true), 0.5 * moved(uneven(), false));
}

TEST(Levelling, NeitherHangingNorFreelySlippingLayersLevel) {
  State s = uneven();
  const std::vector<double> before = s.volumes;
  const State start = s;
  Stage stage = on_floor(start);
  ASSERT_TRUE(level_layers(stage, {0, 0, 9}, {}, false, 1, s));
  EXPECT_EQ(s.volumes, before);
  for (WallSite& site : stage.sites)
    site.slip_length = free_slip;
  stage.liquids[0].liquid.surface_tension = 0.1;
  ASSERT_TRUE(level_layers(stage, {0, 0, -9}, {}, false, 1, s));
  EXPECT_EQ(s.volumes, before);
}

} // namespace
} // namespace sheet
