// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/mesh_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "formats/cpp/mesh_export.h"
#include "libsheet/base/error.h"
#include "libsheet/shape/perturb.h"
#include "libsheet/shape/shapes.h"
#include "tests/unit/own_path.h"

namespace sheet {
namespace {

ExitCode code_of(const std::string& path) {
  try {
    (void)load_mesh(path);
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::ok;
}

TEST(MeshFile, RoundTripWithThicknessAndVelocity) {
  TriangleMesh mesh = make_disk(1.0, {Pattern::irregular, 0.2, 1, {}});
  set_thickness(mesh, 0.02, plane_wave(0.01, 0.5, {1, 0, 0}));
  mesh.triangle_thickness.assign(mesh.triangles.size(), 0.1 / 3.0);
  mesh.velocities.assign(mesh.positions.size(), {0.1, -2, 1e-9});
  for (const char* ending : {"ply", "vtu"}) {
    const std::string path = test::own_path(std::string("mesh_file.") + ending);
    save_mesh(path, mesh);
    const LoadedMesh back = load_mesh(path);
    EXPECT_EQ(back.mesh.positions, mesh.positions);
    EXPECT_EQ(back.mesh.triangles, mesh.triangles);
    EXPECT_EQ(back.mesh.vertex_thickness, mesh.vertex_thickness);
    EXPECT_EQ(back.mesh.triangle_thickness, mesh.triangle_thickness);
    EXPECT_EQ(back.mesh.velocities, mesh.velocities);
    EXPECT_TRUE(back.notes.empty());
    std::remove(path.c_str());
  }
}

TEST(MeshFile, ErrorsHaveTheirExitCodes) {
  EXPECT_EQ(code_of("/nonexistent/a.obj"), ExitCode::io);
  EXPECT_EQ(code_of("/nonexistent/a.xyz"), ExitCode::bad_input);
  TriangleMesh mesh = make_disk(1.0, {Pattern::irregular, 0.5, 1, {}});
  mesh.vertex_thickness.assign(mesh.positions.size(), -1.0);
  const std::string path = test::own_path("negative.ply");
  save_mesh(path, mesh);
  EXPECT_EQ(code_of(path), ExitCode::bad_input);
  std::remove(path.c_str());
  EXPECT_THROW(save_mesh("/nonexistent/a.ply", mesh), Error);
}

TEST(MeshFile, AnArrayThatIsAskedForMustBeThereAndFinite) {
  const std::string path = test::own_path("arrays.ply");
  const auto write = [&](double value) {
    formats::ForeignMesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.arrays.push_back({"dye", formats::MeshPlace::point, 1, {1, value, 3}});
    formats::export_mesh(path, mesh);
  };
  const auto message = [&](const std::string& name) -> std::string {
    try {
      (void)load_mesh(path, std::array{name});
    } catch (const Error& error) {
      return error.what();
    }
    return "fine";
  };
  write(2);
  EXPECT_EQ(load_mesh(path, std::array{std::string("dye")}).mesh.arrays.at(0).values, (std::vector<double>{1, 2, 3}));
  EXPECT_NE(message("uv").find(path + ": there is no array \"uv\""), std::string::npos);
  write(std::nan(""));
  EXPECT_NE(message("dye").find("array 'dye' has a value that is not finite"), std::string::npos) << message("dye");
  std::remove(path.c_str());
}

} // namespace
} // namespace sheet
