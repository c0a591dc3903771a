// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/free_turning.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/solve/step.h"
#include "tests/support/holds.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

TEST(FreeTurning, EachPieceStopsAndKeepsTheRest) {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const Connectivity mesh = connect(6, std::vector<Corners>{{0, 1, 2}, {3, 4, 5}});
  std::vector<Vector3> v, rest;
  for (std::size_t k = 0; k < x.size(); ++k) { // stretching and drifting, and each turning by its own rate
    const Vector3 middle = (x[k / 3 * 3] + x[k / 3 * 3 + 1] + x[k / 3 * 3 + 2]) / 3;
    rest.push_back(0.3 * (x[k] - middle) + Vector3(1, -2, 0.5));
    v.push_back(rest[k] + (k < 3 ? 2.0 : -7.0) * Vector3::UnitZ().cross(x[k] - middle));
  }
  stop_turning({{0, 0, 0, 3, 3, 3}, std::vector<bool>(6, false)}, x, {0, 0, -9.81}, v);
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_LT((v[k] - rest[k]).norm(), 1e-14);
}

// By (2 m/s, 0) for half a second, of the first piece; the other one is not free.
TEST(FreeTurning, CentresOfMassDriftSteadilyAlongTheBath) {
  const std::vector<Vector3> start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  const std::vector<double> volumes{1, 2, 3, 1, 1, 1};
  const std::vector<Vector3> velocities(6, {2, 0, 1});
  std::vector<Vector3> x, v;
  for (std::size_t k = 0; k < start.size(); ++k) {
    x.emplace_back(0.9 * start[k] + Vector3(0.2, -0.1, 0.3));
    v.emplace_back(2.0 * static_cast<double>(k), 1, -4);
  }
  const std::vector<Vector3> x_before = x, v_before = v;
  const FreePieces free{{0, 0, 0, no_index, no_index, no_index}, std::vector<bool>(6, false)};
  drift_steadily(free, {start, velocities, volumes}, 0.5, {0, 0, -9.81}, x, v);
  Vector3 way = Vector3::Zero(), flow = Vector3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    way += volumes[k] / 6 * (x[k] - start[k]);
    flow += volumes[k] / 6 * v[k];
    EXPECT_LT((x[k] - x[0] - (x_before[k] - x_before[0])).norm(), 1e-15); // as a whole
  }
  EXPECT_LT((way - Vector3(1, 0, 0.3)).norm(), 1e-15);
  EXPECT_LT((flow - Vector3(2, 0, -4)).norm(), 1e-15);
  for (std::size_t k = 3; k < 6; ++k) {
    EXPECT_EQ(x[k], x_before[k]);
    EXPECT_EQ(v[k], v_before[k]);
  }
}

// Of what the bath resists: it may slow down, but neither turns back nor goes another way.
TEST(FreeTurning, WhatTheBathResistsDriftsNoFaster) {
  const std::vector<Vector3> start{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<double> volumes(3, 1);
  const std::vector<Vector3> velocities(3, {2, 0, 0});
  const FreePieces free{{0, 0, 0}, std::vector<bool>(3, true)};
  for (const auto& [now, left] : {std::pair(3, 2), std::pair(1, 1), std::pair(-1, 0)}) {
    std::vector<Vector3> x(start), v(3, Vector3(now, 1, 5));
    for (Vector3& place : x)
      place += 0.5 * v[0];
    drift_steadily(free, {start, velocities, volumes}, 0.5, {0, 0, -9.81}, x, v);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((v[k] - Vector3(left, 0, 5)).norm(), 1e-15);
      EXPECT_LT((x[k] - start[k] - 0.5 * v[k]).norm(), 1e-15);
    }
  }
}

// One piece is held at a point that moves, another one at two points, by something that turns about their axis: what
// they turn beyond that goes, about the point, and about the axis only, along which it may shear. The third one is held
// at three.
TEST(FreeTurning, WhatIsHeldAtOneOrTwoPointsStopsAsSeenFromWhatHoldsIt) {
  std::vector<Vector3> x, wanted, v;
  for (int piece = 0; piece < 3; ++piece)
    for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0.2, 1, 0.1), Vector3(0.5, 0.3, 1)})
      x.emplace_back(corner + Vector3(5 * piece, 0, 0));
  std::vector<Corners> triangles;
  for (std::uint32_t first : {0U, 4U, 8U})
    for (const Corners& t : {Corners{0, 2, 1}, Corners{0, 1, 3}, Corners{1, 2, 3}, Corners{2, 0, 3}})
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const Connectivity mesh = connect(12, triangles);
  Hold moving, turning, firm;
  moving.vertices = {0};
  test::move_steadily(moving, Vector3::Zero(), Vector3(0.3, -1, 2));
  turning.vertices = {4, 5};
  turning.velocity = [](double, const Vector3& at) { return Vector3(3 * Vector3::UnitX().cross(at)); };
  firm.vertices = {8, 9, 10};
  const Vector3 spins[] = {{4, -5, 6}, {-8, 0, 0}, Vector3::Zero()};
  for (std::size_t k = 0; k < 12; ++k) {
    const Vector3 r = x[k] - x[k / 4 * 4];
    wanted.push_back(k < 4   ? moving.velocity(0.5, x[k])
                     : k < 8 ? Vector3(turning.velocity(0.5, x[k]) + Vector3(3 * r.y() - r.z(), 0, 0))
                             : Vector3(7 * Vector3::UnitZ().cross(r)));
    v.push_back(wanted[k] + spins[k / 4].cross(r));
  }
  stop_turning_about({moving, turning, firm}, 0.5, mesh, x, v);
  for (std::size_t k = 0; k < 12; ++k)
    EXPECT_LT((v[k] - wanted[k]).norm(), 1e-13) << k;
}

// Without, it turned six times as fast after each step, the other way round, until steps were short.
TEST(FreeTurning, APuddleOnABathDoesNotTurn) {
  constexpr double thickness = 0.012;
  State s = test::at_rest(test::rectangle(0.6, 0.6, 8, 8, 0.25), thickness);
  for (Vector3& x : s.positions)
    x.z() = -thickness * 2400 / 6500;
  Model m;
  m.liquid = {.viscosity = 1390, .density = 2400, .surface_tension = 0.1775};
  m.gravity = {0, 0, -9.81};
  m.bath = BathLiquid{.density = 6500, .spreads = true};
  m.inertia = false;
  Stepper stepper(m, {});
  for (int k = 0; k < 10; ++k)
    (void)stepper.step(s, 5);
  double turning = 0, moment = 0;
  Vector3 middle = Vector3::Zero();
  for (const Vector3& x : s.positions)
    middle += x / static_cast<double>(s.positions.size());
  double fastest = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const Vector3 tangent = Vector3::UnitZ().cross(s.positions[v] - middle);
    turning += tangent.dot(s.velocities[v]);
    moment += tangent.squaredNorm();
    fastest = std::max(fastest, s.velocities[v].norm());
  }
  EXPECT_LT(std::abs(turning / moment), 1e-3 * fastest);
}

} // namespace
} // namespace sheet
