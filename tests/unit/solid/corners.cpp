// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/corners.h"

#include <gtest/gtest.h>

#include "libsheet/sheet/sheet.h"

namespace sheet::solid {
namespace {

// A box whose side is x = 0, and a floor y = 0.
Scene side_and_floor() {
  Scene scene;
  scene.solids.resize(2);
  scene.solids[0].shape = scene::SolidBox{{0.2, 0.2, 0.2}};
  scene.solids[0].center = {-0.1, 0.1, 0};
  scene.solids[1].shape = scene::HalfSpace{{0, 1, 0}};
  for (scene::Solid& solid : scene.solids)
    solid.contact = SolidContact::flow;
  return scene;
}

// To what a vertex turns at this place, 5 mm thick with edges of 4 mm, that rides on a solid; as does another one
// beside it.
std::int32_t turned(const Scene& scene, const Vector3& x, std::int32_t rides, std::int32_t beside) {
  const std::vector<Vector3> places = {x, x + Vector3(0, 0, 4e-3), x + Vector3(0, 4e-3, 0)};
  const std::vector<Corners> triangles = {{0, 1, 2}};
  const std::vector<double> thickness(3, 5e-3), edges(3, 4e-3);
  const std::vector<std::int32_t> all = {rides, rides, beside};
  return turned_to(Solids(scene), {places, triangles, thickness, edges, all, 0, {0, -9.81, 0}})[0];
}

TEST(Corners, WhatRunsDownASideTurnsToTheFloor) {
  Scene scene = side_and_floor();
  EXPECT_EQ(turned(scene, {2.5e-3, 8e-3, 0}, 0, 0), 1);
  EXPECT_EQ(turned(scene, {2.5e-3, 0.05, 0}, 0, 0), no_solid); // far above it
  scene.solids[1].contact = SolidContact::stick;
  EXPECT_EQ(turned(scene, {2.5e-3, 8e-3, 0}, 0, 0), no_solid);
  scene = side_and_floor();
  scene.solids[1].motion = scene::Translating{{{{0, Eigen::Vector3d(0.1, 0, 0)}}}};
  EXPECT_EQ(turned(scene, {2.5e-3, 8e-3, 0}, 0, 0), no_solid);
}

// A pool beside the side of its dish does not climb it; what has come down there turns.
TEST(Corners, WhatLiesOnTheFloorTurnsOnlyIfItComesFromTheSide) {
  const Scene scene = side_and_floor();
  EXPECT_EQ(turned(scene, {3e-3, 2.5e-3, 0}, 1, 1), no_solid);
  EXPECT_EQ(turned(scene, {3e-3, 2.5e-3, 0}, 1, 0), 0);
  EXPECT_EQ(turned(scene, {3e-3, 2.5e-3, 0}, 1, no_solid), no_solid);
}

} // namespace
} // namespace sheet::solid
