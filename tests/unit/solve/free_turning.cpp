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
  stop_turning(mesh, x, {0, 0, -9.81}, v);
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_LT((v[k] - rest[k]).norm(), 1e-14);
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
