// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/seam_texture.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "formats/cpp/mesh_export.h"

namespace sheet {
namespace {

using formats::ForeignMesh;
using formats::MeshPlace;

// Two squares side by side, of two triangles each, whose maps are x and y in the left one and 9 - x and y in the right
// one; the file has them at corners.
ForeignMesh squares() {
  ForeignMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}};
  return mesh;
}

void save(const std::string& name) {
  ForeignMesh mesh = squares();
  formats::MeshArray corners{"a.corner_uv", MeshPlace::cell, 6, {}};
  for (std::size_t t = 0; t < 4; ++t)
    for (const std::uint32_t v : mesh.triangles[t]) {
      const auto& x = mesh.points[v];
      corners.values.insert(corners.values.end(), {t < 2 ? x[0] : 9 - x[0], x[1]});
    }
  mesh.arrays.push_back(corners);
  formats::export_mesh(name, mesh);
}

Scene scene_of(const std::string& file, std::size_t sheets) {
  Scene scene;
  scene.sheets.assign(sheets, {});
  scene.sheets.back().shape = scene::SheetMesh{file, 1};
  scene.sheets.back().arrays = {"a.rest"};
  return scene;
}

// What a run makes of it: other triangles, which are elsewhere, and know where they were.
ForeignMesh remeshed() {
  ForeignMesh mesh;
  mesh.points = {{7, 0, 0}, {7, 1, 0}, {7, 0, 1}, {7, 1, 1}, {7, 2, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {1, 4, 3}};
  mesh.arrays.push_back({"a.rest", MeshPlace::point, 3, {0.25, 0, 0, 1, 0.25, 0, 0.5, 1, 0, 1, 1, 0, 1.5, 0.75, 0}});
  return mesh;
}

class SeamTexture : public testing::Test {
protected:
  SeamTexture() { save(file_); }
  ~SeamTexture() override { std::remove(file_.c_str()); }
  std::string file_ = testing::TempDir() + "seam_texture_test_" + std::to_string(::getpid()) + ".ply";
};

TEST_F(SeamTexture, IsLookedUpInTheIslandOfTheTriangle) {
  ForeignMesh mesh = remeshed();
  SeamTextures textures;
  textures.add(scene_of(file_, 1), mesh);
  ASSERT_NE(mesh.corner_texture(), nullptr);
  EXPECT_EQ(mesh.corner_texture()->name, "a.corner_uv");
  const std::vector<double> wanted{0.25, 0, 1, 0.25, 0.5, 1, 1, 0.25, 1, 1, 0.5, 1, 8, 0.25, 7.5, 0.75, 8, 1};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(mesh.corner_texture()->values[i], wanted[i], 1e-14) << i;
}

TEST_F(SeamTexture, TheFilesOwnTrianglesGetTheirs) {
  ForeignMesh mesh = squares();
  formats::MeshArray rest{"a.rest", MeshPlace::point, 3, {}};
  for (const auto& x : mesh.points)
    rest.values.insert(rest.values.end(), x.begin(), x.end());
  mesh.arrays.push_back(rest);
  SeamTextures textures;
  textures.add(scene_of(file_, 1), mesh);
  ASSERT_NE(mesh.corner_texture(), nullptr);
  for (std::size_t t = 0; t < 4; ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& x = mesh.points[mesh.triangles[t][i]];
      EXPECT_NEAR(mesh.corner_texture()->values[6 * t + 2 * i], t < 2 ? x[0] : 9 - x[0], 1e-14);
      EXPECT_NEAR(mesh.corner_texture()->values[6 * t + 2 * i + 1], x[1], 1e-14);
    }
}

// A tube of six sides, u from 0 to 6 around: one island that meets itself.
TEST_F(SeamTexture, AnIslandThatMeetsItselfKeepsItsSidesApart) {
  ForeignMesh tube;
  formats::MeshArray corners{"a.corner_uv", MeshPlace::cell, 6, {}}, rest{"a.rest", MeshPlace::point, 3, {}};
  for (int i = 0; i < 12; ++i)
    tube.points.push_back({std::cos(i / 2 * M_PI / 3), std::sin(i / 2 * M_PI / 3), i % 2 * 1.0});
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % 6);
    tube.triangles.push_back({a, b, a + 1});
    tube.triangles.push_back({b, b + 1, a + 1});
    const double u = i;
    corners.values.insert(corners.values.end(), {u, 0, u + 1, 0, u, 1, u + 1, 0, u + 1, 1, u, 1});
  }
  for (const auto& x : tube.points)
    rest.values.insert(rest.values.end(), x.begin(), x.end());
  tube.arrays = {corners};
  formats::export_mesh(file_, tube);
  tube.arrays = {rest};
  SeamTextures textures;
  textures.add(scene_of(file_, 1), tube);
  ASSERT_NE(tube.corner_texture(), nullptr);
  for (std::size_t i = 0; i < corners.values.size(); ++i)
    EXPECT_NEAR(tube.corner_texture()->values[i], corners.values[i], 1e-12) << i;
  // one that reaches over the seam: its middle is before it, so what is behind it has u = 6
  tube.triangles = {{0, 1, 2}};
  tube.points.resize(3);
  tube.arrays = {
      {"a.rest",
       MeshPlace::point,
       3,
       {0.625, -std::sqrt(3) * 0.375, 0.5, 0.75, -std::sqrt(3) * 0.25, 0.25, 0.99, 0.01 * std::sqrt(3), 0.5}}};
  textures.add(scene_of(file_, 1), tube);
  const std::vector<double>& uv = tube.corner_texture()->values;
  EXPECT_NEAR(uv[0], 5.25, 1e-12);
  EXPECT_NEAR(uv[2], 5.5, 1e-12);
  EXPECT_NEAR(uv[4], 6, 0.02);
  EXPECT_NEAR(uv[5], 0.5, 1e-12);
}

TEST_F(SeamTexture, OfSeveralSheetsEachHasItsOwn) {
  ForeignMesh mesh = remeshed();
  mesh.arrays.push_back({"a.uv", MeshPlace::point, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}});
  mesh.arrays.push_back({"a.sheet", MeshPlace::cell, 1, {0, 0, 1}});
  mesh.arrays[0].values[0] = 99; // nowhere in the file, but of the other sheet
  SeamTextures textures;
  textures.add(scene_of(file_, 2), mesh);
  ASSERT_NE(mesh.corner_texture(), nullptr);
  const std::vector<double> wanted{1, 2, 3, 4, 5, 6, 3, 4, 7, 8, 5, 6, 8, 0.25, 7.5, 0.75, 8, 1};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(mesh.corner_texture()->values[i], wanted[i], 1e-14) << i;
}

TEST_F(SeamTexture, TrianglesOfNoSheetHaveNone) {
  ForeignMesh mesh = remeshed();
  mesh.arrays.push_back({"a.sheet", MeshPlace::cell, 1, {-3, 0, std::nan("")}});
  SeamTextures textures;
  textures.add(scene_of(file_, 1), mesh);
  ASSERT_NE(mesh.corner_texture(), nullptr);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(mesh.corner_texture()->values[i], 0);
    EXPECT_EQ(mesh.corner_texture()->values[12 + i], 0);
  }
}

TEST_F(SeamTexture, IsLeftOutWithoutItsFileOrWithAnother) {
  const auto added = [&](const Scene& scene, double shift) {
    ForeignMesh mesh = remeshed();
    for (double& x : mesh.arrays[0].values)
      x += shift;
    SeamTextures textures;
    testing::internal::CaptureStderr();
    textures.add(scene, mesh);
    textures.add(scene, mesh); // told once
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_EQ(mesh.corner_texture() != nullptr, told.empty());
    EXPECT_EQ(told.find("seams"), told.rfind("seams"));
    return told;
  };
  EXPECT_EQ(added(scene_of(file_, 1), 0), "");
  EXPECT_NE(added(scene_of("no/such/mesh-of-nowhere.ply", 1), 0).find("is neither beside the stream nor above it"),
            std::string::npos);
  EXPECT_NE(added(scene_of(file_, 1), 50).find("is not the mesh that the run began with"), std::string::npos);
  Scene plain = scene_of(file_, 1);
  plain.sheets[0].arrays.clear();
  ForeignMesh mesh = remeshed();
  SeamTextures().add(plain, mesh);
  EXPECT_EQ(mesh.corner_texture(), nullptr);
}

} // namespace
} // namespace sheet
