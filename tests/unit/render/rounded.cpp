// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces with finer, rounder triangles against spheres, and against themselves where they are to stay flat.
#include "libsheet/render/rounded.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

constexpr double thick = 0.1;

std::vector<float> everywhere(const Surface& surface, float roundness) {
  return std::vector<float>(surface.thickness.size(), roundness);
}

// The greatest distance of the outer side's edges' and faces' middles from the sphere that the vertices are on.
double off_the_sphere(const Surface& s) {
  double most = 0;
  for (std::size_t n = 0; n < s.triangles.size(); ++n) {
    const Corners& t = s.triangles[n];
    const Vector3 middle = (s.positions[t[0]] + s.positions[t[1]] + s.positions[t[2]]) / 3;
    if (s.on_bead[n] || middle.norm() < 0.5 || middle.z() > 0 || std::abs(middle.y()) > 0.4) // a seam, thin triangles
      continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 half = (s.positions[t[i]] + s.positions[t[(i + 1) % 3]]) / 2;
      most = std::max(most, std::abs(half.norm() - (0.5 + thick / 2)));
    }
    most = std::max(most, std::abs(middle.norm() - (0.5 + thick / 2)));
  }
  return most;
}

TEST(Rounded, ComesNearerToASphere) {
  const Surface ball = make_surface(middle_of(test::ball(16, thick)), 1e-6);
  std::vector<float> roundness = everywhere(ball, 1);
  const Surface once = rounded(ball, roundness);
  const Surface twice = rounded(once, roundness);
  EXPECT_EQ(roundness.size(), twice.thickness.size());
  EXPECT_EQ(twice.triangles.size(), 16 * ball.triangles.size());
  EXPECT_LT(off_the_sphere(once), 0.4 * off_the_sphere(ball)); // a quarter by halved edges
  EXPECT_LT(off_the_sphere(twice), 0.4 * off_the_sphere(once));
  for (std::size_t t = 0; t < twice.triangles.size(); ++t)
    for (const std::uint32_t p : twice.triangles[t]) {
      const Vector3& x = twice.positions[p];
      if (!twice.on_bead[t] && x.norm() > 0.5 && std::abs(x.y()) < 0.4 && x.z() < 0.3) { // it has a seam
        EXPECT_GT(twice.normals[p].dot(x.normalized().cast<float>()), 0.99F);
      }
    }
}

TEST(Rounded, StaysWhereItIsToStayFlat) {
  const Surface ball = make_surface(middle_of(test::ball(8, thick)), 1e-6);
  std::vector<float> roundness = everywhere(ball, 0);
  const Surface fine = rounded(ball, roundness);
  for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
    const Corners& from = ball.triangles[t / 4];
    const Vector3 a = ball.positions[from[0]];
    const Vector3 normal = (ball.positions[from[1]] - a).cross(ball.positions[from[2]] - a);
    for (const std::uint32_t p : fine.triangles[t])
      EXPECT_NEAR((fine.positions[p] - a).dot(normal), 0, 1e-15);
    EXPECT_EQ(fine.source_triangle[t], ball.source_triangle[t / 4]);
  }
}

TEST(Rounded, IsAsClosedAsItWas) {
  const Surface trough = make_surface(middle_of(test::trough(6, thick)), 1e-6);
  std::vector<float> roundness = everywhere(trough, 0.7F);
  const Surface fine = rounded(trough, roundness);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Corners& t : fine.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      ++sides[{t[i], t[(i + 1) % 3]}];
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({side.second, side.first}), 1U);
  }
}

} // namespace
} // namespace sheet::render
