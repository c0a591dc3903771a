// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/corners.h"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <gtest/gtest.h>

#include "libsheet/sheet/sheet.h"
#include "tests/unit/own_path.h"

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

// A step of one mesh, 0.1 m high, and its floor y = 0, written to a file of this name.
Scene step_of_one_mesh(const std::string& file) {
  const std::vector<std::pair<double, double>> outline = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0},
                                                          {0, 0},       {0, 0.1},    {-0.2, 0.1}};
  std::ofstream out(file);
  for (const double z : {-0.1, 0.1})
    for (const auto& [x, y] : outline)
      out << fmt::format("v {} {} {}\n", x, y, z);
  for (const auto& [a, b, c] : std::vector<Corners>{{1, 2, 3}, {1, 3, 4}, {1, 4, 6}, {4, 5, 6}})
    out << fmt::format("f {} {} {}\nf {} {} {}\n", a, c, b, a + 6, b + 6, c + 6);
  for (int i = 1; i <= 6; ++i)
    out << fmt::format("f {} {} {}\nf {} {} {}\n", i, i % 6 + 1, i % 6 + 7, i, i % 6 + 7, i + 6);
  out.close();
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::SolidMesh{.file = file, .scale = 1, .voxel_size = {}, .checksum = {}};
  scene.solids[0].contact = SolidContact::flow;
  return scene;
}

// What lies along the side, and what lies on the floor beside it.
TEST(Corners, WhatRunsDownTheSideOfAMeshTurns) {
  const Scene scene = step_of_one_mesh(test::own_path("corners_step.obj"));
  const auto turns = [&](const Vector3& x, const Vector3& along) {
    const std::vector<Vector3> places = {x, x + Vector3(0, 0, 4e-3), x + 4e-3 * along};
    const std::vector<Corners> triangles = {{0, 1, 2}};
    const std::vector<double> thickness(3, 5e-3), edges(3, 4e-3);
    const std::vector<std::int32_t> all(3, 0);
    return turned_to(Solids(scene), {places, triangles, thickness, edges, all, 0, {0, -9.81, 0}})[0];
  };
  EXPECT_EQ(turns({2.5e-3, 8e-3, 0}, {0, 1, 0}), 0);
  EXPECT_EQ(turns({2.5e-3, 0.08, 0}, {0, 1, 0}), no_solid);
  EXPECT_EQ(turns({2e-3, 2.5e-3, 0}, {1, 0, 0}), no_solid);
}

} // namespace
} // namespace sheet::solid
