// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/solids.h"

#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "tests/unit/own_path.h"

namespace sheet::render {
namespace {

using std::numbers::pi;

TEST(Solids, HaveTheirVolumeAndFaceOutwards) {
  const std::pair<scene::SolidShape, double> cases[] = {{scene::Sphere{0.5}, 4 * pi / 3 * 0.125},
                                                        {scene::SolidBox{{1, 2, 3}}, 6},
                                                        {scene::Capsule{0.5, 2}, 4 * pi / 3 * 0.125 + pi * 0.25 * 2},
                                                        {scene::Cylinder{0.5, 2}, pi * 0.25 * 2}};
  for (const auto& [shape, volume] : cases) {
    Scene scene;
    scene.solids.resize(1);
    scene.solids[0].shape = shape;
    scene.solids[0].center = {3, 4, 5};
    scene.solids[0].rotation = scene::Rotation{{1, 1, 0}, 0.7};
    const SolidMesh mesh = make_solids(scene)[0];
    double sum = 0;
    for (const Corners& t : mesh.triangles) {
      const Vector3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
      sum += (a - Vector3(3, 4, 5)).dot((b - Vector3(3, 4, 5)).cross(c - Vector3(3, 4, 5))) / 6;
      const Vector3 n = (b - a).cross(c - a).normalized();
      for (const std::uint32_t v : t)
        EXPECT_GT(n.dot(mesh.normals[v].cast<double>()), 0.9);
    }
    EXPECT_NEAR(sum, volume, 2e-3 * volume);
  }
}

TEST(Solids, PlanesMoveWithTheirMotion) {
  Scene scene;
  scene.solids.resize(2);
  scene.solids[1].shape = scene::HalfSpace{{0, 0, 2}};
  scene.solids[1].center = {0, 0, 1};
  scene::Rotating turning;
  turning.axis = {1, 0, 0};
  turning.rate.entries = {{0, pi / 2}};
  scene.solids[1].motion = turning;
  const std::vector<Plane> planes = make_planes(scene, 1);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_EQ(planes[0].id, first_solid_id + 1);
  EXPECT_NEAR((planes[0].normal - Vector3(0, -1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((planes[0].point - Vector3(0, -1, 0)).norm(), 0, 1e-12);
}

TEST(Solids, PlanesThatFaceEachOtherLetLightIn) {
  const auto let_in = [](const std::vector<Vector3>& normals) {
    Scene scene;
    for (const Vector3& normal : normals)
      scene.solids.emplace_back().shape = scene::HalfSpace{normal};
    std::vector<bool> which;
    for (const Plane& plane : make_planes(scene, 0))
      which.push_back(plane.lets_light_in);
    return which;
  };
  EXPECT_EQ(let_in({{0, 1, 0}}), std::vector{false});
  EXPECT_EQ(let_in({{0, 1, 0}, {1, 0, 0}}), (std::vector{false, false})); // a wall on the ground
  EXPECT_EQ(let_in({{0, 1, 0}, {1, 0.1, 0}, {-1, 0.1, 0}}), (std::vector{false, true, true}));
}

// A cube's faces are flat, what is only a facet of something round is smooth.
TEST(Solids, MeshesHaveCreases) {
  const std::string file = sheet::test::own_path("creases.obj");
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                         "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\n"
                         "f 2 4 8\nf 2 8 6\n";
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::SolidMesh{file, 1, {}};
  const std::vector<SolidMesh> meshes = make_solids(scene);
  ASSERT_EQ(meshes.size(), 1U);
  const SolidMesh& cube = meshes[0];
  EXPECT_EQ(cube.positions.size(), 24U);
  EXPECT_EQ(cube.triangles.size(), 12U);
  for (const Corners& t : cube.triangles) {
    const Vector3 n = (cube.positions[t[1]] - cube.positions[t[0]]).cross(cube.positions[t[2]] - cube.positions[t[0]]);
    EXPECT_NEAR(n.norm(), 1, 1e-12);
    for (const std::uint32_t v : t)
      EXPECT_LT((cube.normals[v] - n.cast<float>()).norm(), 1e-6);
  }
  // A roof of 20 degrees has one normal along its ridge.
  std::ofstream(file) << "v 0 -1 0\nv 1 -1 0\nv 0 0 0.176\nv 1 0 0.176\nv 0 1 0\nv 1 1 0\n"
                         "f 1 2 4\nf 1 4 3\nf 3 4 6\nf 3 6 5\nf 1 5 6\nf 1 6 2\nf 1 3 5\nf 2 6 4\n";
  const SolidMesh roof = make_solids(scene)[0];
  int ridge = 0; // but those of the gables
  for (std::size_t v = 0; v < roof.positions.size(); ++v)
    ridge += roof.positions[v].z() > 0 && roof.normals[v].z() > 0.5F;
  EXPECT_EQ(ridge, 2);
}

TEST(Solids, AMissingFileIsNamed) {
  Scene scene;
  scene.solids.resize(2);
  scene.solids[1].shape = scene::SolidMesh{"nowhere.off", 1, {}};
  try {
    static_cast<void>(make_solids(scene));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find("[[solid]] 1"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("nowhere.off"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace sheet::render
