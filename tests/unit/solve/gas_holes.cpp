// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/gas_holes.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace sheet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A unit square of two by two squares, in the plane z = 0.
struct Square {
  std::vector<Vector3> positions;
  Connectivity mesh;
  Square() {
    std::vector<Corners> triangles;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        positions.emplace_back(i / 2.0, j / 2.0, 0);
    for (std::uint32_t j = 0; j < 2; ++j)
      for (std::uint32_t i = 0; i < 2; ++i) {
        const std::uint32_t a = 3 * j + i;
        triangles.push_back({a, a + 1, a + 4});
        triangles.push_back({a, a + 4, a + 3});
      }
    mesh = connect(positions.size(), triangles);
  }
};

TEST(GasHoles, AnOpenRimHasTheAreaThatItGoesRound) {
  const Square s;
  const std::vector<double> open(s.positions.size(), infinity);
  const GasHoles holes = gas_holes(s.mesh, s.positions, open, {});
  EXPECT_DOUBLE_EQ(holes.area, 1);
  EXPECT_NEAR((holes.place - Vector3(0.5, 0.5, 0)).norm(), 0, 1e-15);
}

TEST(GasHoles, ARimThatIsClosedHasNone) {
  const Square s;
  EXPECT_EQ(gas_holes(s.mesh, s.positions, std::vector<double>(s.positions.size(), 0), {}).area, 0);
}

// Open at the corner (1, 1) and closed at all other vertices: the two edges there, and the chord.
TEST(GasHoles, AnOpenPartIsClosedByItsChord) {
  const Square s;
  std::vector<double> clearances(s.positions.size(), 0);
  clearances[8] = infinity;
  EXPECT_DOUBLE_EQ(gas_holes(s.mesh, s.positions, clearances, {}).area, 0.125);
}

TEST(GasHoles, OverASolidGasHasTheGap) {
  const Square s;
  const std::vector<double> clearances(s.positions.size(), 0.01);
  EXPECT_NEAR(gas_holes(s.mesh, s.positions, clearances, {}).area, 4 * 0.01, 1e-15);
}

// A cap of a ball from which a flat piece has come off: that encloses nothing.
TEST(GasHoles, WhatHasComeOffEnclosesNothing) {
  test::Mesh ball = test::icosphere(2);
  const auto low = [&](const Corners& c) { return ball.positions[c[0]].z() < 0.5; };
  std::vector<Corners> triangles;
  for (const Corners& c : ball.triangles)
    if (low(c))
      triangles.push_back(c);
  const std::size_t kept = triangles.size();
  const auto first = static_cast<std::uint32_t>(ball.positions.size());
  for (const Vector3& x : {Vector3(0, 0, 2), Vector3(1, 0, 2), Vector3(0, 1, 2)})
    ball.positions.push_back(x);
  triangles.push_back({first, first + 1, first + 2});
  const Connectivity mesh = connect(ball.positions.size(), triangles);
  const std::vector<double> open(ball.positions.size(), infinity);
  const std::vector<char> part = still_enclosing(mesh, ball.positions, open, {});
  EXPECT_EQ(std::count(part.begin(), part.end(), 1), static_cast<std::ptrdiff_t>(kept));
  EXPECT_EQ(part.back(), 0);
  EXPECT_LT(gas_holes(mesh, ball.positions, open, part).area, gas_holes(mesh, ball.positions, open, {}).area);
}

// A half ball with its rim 0.1 m under the level holds what a bath of 1000 Pa/m presses there, and no more; a disk
// nothing.
TEST(GasHoles, ABathHoldsGasAsADivingBell) {
  test::Mesh ball = test::icosphere(3);
  std::erase_if(ball.triangles, [&](const Corners& c) {
    return std::ranges::any_of(c, [&](auto v) { return ball.positions[v].z() < -1e-9; });
  });
  const std::size_t n = ball.positions.size();
  const RimClearances rims{.with_bath = std::vector<double>(n, 0),
                           .without = std::vector<double>(n, infinity),
                           .depths = std::vector<double>(n, 0.1)};
  const auto held = [&](std::span<const Vector3> x, double pressure) {
    return clearances_at(rims, connect(n, ball.triangles), x, {}, 1000, pressure).data() == rims.with_bath.data();
  };
  EXPECT_TRUE(held(ball.positions, 99));
  EXPECT_FALSE(held(ball.positions, 101));
  for (Vector3& x : ball.positions)
    x.z() *= 0.01;
  EXPECT_FALSE(held(ball.positions, 99));
}

} // namespace
} // namespace sheet
