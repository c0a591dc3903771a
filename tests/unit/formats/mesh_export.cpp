// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cpp/mesh_export.h"

#include <clocale>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/cpp/base64.h"
#include "formats/cpp/mesh_import.h"
#include "formats/cpp/text_scan.h"

namespace sheet::formats {
namespace {

// Values that a careless writer would spoil.
ForeignMesh awkward_mesh() {
  ForeignMesh mesh;
  mesh.points = {{0.1, 1.0 / 3.0, -1e-300}, {1e300, 0, -0.0}, {5e-324, 2, 123456789.123456789}, {1, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  mesh.arrays.push_back({"thickness", MeshPlace::point, 1, {0.1, 0.2, 0.3, 1.0 / 7.0}});
  mesh.arrays.push_back({"thickness", MeshPlace::cell, 1, {1e-5, 2.0 / 3.0}});
  mesh.arrays.push_back({"velocity", MeshPlace::point, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
  mesh.arrays.push_back({"a <b> & \"c\"", MeshPlace::cell, 2, {1, 2, 3, 4}});
  return mesh;
}

TEST(MeshExport, RoundTripsAreExact) {
  const ForeignMesh mesh = awkward_mesh();
  for (const MeshFormat format : {MeshFormat::vtu, MeshFormat::ply, MeshFormat::obj, MeshFormat::off}) {
    const MeshImport import = import_mesh(encode_mesh(mesh, format), format, "file");
    EXPECT_EQ(import.mesh.points, mesh.points);
    EXPECT_EQ(import.mesh.triangles, mesh.triangles);
    if (format == MeshFormat::vtu || format == MeshFormat::ply)
      for (const std::size_t i : {0U, 1U, 2U}) {
        const MeshArray* array = import.mesh.find(mesh.arrays[i].name, mesh.arrays[i].place);
        ASSERT_TRUE(array);
        EXPECT_EQ(array->values, mesh.arrays[i].values);
      }
  }
}

TEST(MeshExport, StlKeepsShapeInSinglePrecision) {
  ForeignMesh mesh;
  mesh.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0.1, 0.2, 1}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  const ForeignMesh back = import_stl(encode_stl(mesh), "file").mesh;
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.points[1][0], static_cast<double>(0.1f));
}

TEST(MeshExport, NumbersDoNotDependOnTheLocale) {
  const std::string before = encode_obj(awkward_mesh());
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name))
      break;
  EXPECT_EQ(encode_obj(awkward_mesh()), before);
  EXPECT_EQ(parse_real("0.5"), 0.5);
  std::setlocale(LC_ALL, "C");
}

TEST(MeshExport, PlySaysItsTimeInAComment) {
  ForeignMesh mesh = awkward_mesh();
  mesh.time = 0.1;
  EXPECT_NE(encode_ply(mesh).find("\ncomment time 0.1\nelement vertex "), std::string::npos);
  mesh.time.reset();
  EXPECT_EQ(encode_ply(mesh).find("comment time"), std::string::npos);
}

TEST(MeshExport, PvdNamesTimesAndFiles) {
  const std::vector<PvdEntry> entries = {{0.0, "a.vtu"}, {0.1, "b&c.vtu"}};
  const std::string text = encode_pvd(entries);
  EXPECT_THAT(text, testing::HasSubstr("<DataSet timestep=\"0.1\" part=\"0\" file=\"b&amp;c.vtu\"/>"));
}

TEST(MeshExport, RefusesWrongMeshes) {
  ForeignMesh mesh = awkward_mesh();
  mesh.triangles[0][0] = 4;
  EXPECT_THROW((void)encode_obj(mesh), std::invalid_argument);
  mesh = awkward_mesh();
  mesh.arrays[2].values.pop_back();
  EXPECT_THROW((void)encode_vtu(mesh), std::invalid_argument);
  EXPECT_THROW(export_mesh("/nonexistent/a.ply", awkward_mesh()), MeshFileError);
  EXPECT_THROW(export_mesh("/tmp/a.xyz", awkward_mesh()), MeshFileError);
  EXPECT_THROW(export_mesh("/dev/full/a.ply", awkward_mesh()), MeshFileError);
}

TEST(MeshExport, Base64) {
  for (const std::string bytes : {"", "f", "fo", "foo", "foob", "fooba", "foobar"}) {
    std::string text;
    append_base64(text, bytes);
    EXPECT_EQ(decode_base64(text, 100), bytes);
    EXPECT_EQ(decode_base64(" " + text + "\n" + text, 100), bytes + bytes); // padding inside
  }
  EXPECT_EQ(decode_base64("Zm9vYmFy", 4), "foob");
  EXPECT_EQ(decode_base64("Z=9v", 4), std::nullopt);
  EXPECT_EQ(decode_base64("Zm9*", 4), std::nullopt);
}

// Called by readback.py, which reads the files with other programs' readers.
TEST(MeshExport, WritesFilesForReadback) {
  const char* asked = std::getenv("SHEET_READBACK_FOLDER");
  const std::string folder = asked ? asked : testing::TempDir();
  ForeignMesh mesh = awkward_mesh();
  mesh.arrays.pop_back();
  for (const char* ending : {"vtu", "ply", "obj", "off", "stl"})
    export_mesh(folder + "/mesh." + ending, mesh);
  mesh.arrays.erase(mesh.arrays.begin() + 1); // meshio cannot read binary PLY with face properties
  export_mesh(folder + "/points.ply", mesh);
  export_pvd(folder + "/mesh.pvd", std::vector<PvdEntry>{{0.0, "mesh.vtu"}, {0.25, "mesh.vtu"}});
}

TEST(MeshExport, ObjHasSeamsOfTheTexture) {
  ForeignMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
  mesh.arrays.push_back({"uv", MeshPlace::point, 2, {9, 9, 9, 9, 9, 9, 9, 9}}); // of no account
  mesh.arrays.push_back({"corner_uv", MeshPlace::cell, 6, {0, 0, 1, 0, 0, 1, 0, 1, 0.5, 0.5, 0.75, 0}});
  EXPECT_EQ(encode_obj(mesh), "# written by Sheet\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.5\nvt 0.75 0\nf 1/1 2/2 3/3\nf 3/3 2/4 4/5\n");
  mesh.arrays.push_back({"normal", MeshPlace::point, 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}});
  EXPECT_THAT(encode_obj(mesh), testing::HasSubstr("f 1/1/1 2/2/2 3/3/3\nf 3/3/3 2/4/2 4/5/4\n"));
}

TEST(MeshExport, ObjHasTextureAndNormals) {
  ForeignMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_NE(encode_obj(mesh).find("\nf 1 2 3\n"), std::string::npos);
  mesh.arrays.push_back({"normal", MeshPlace::point, 3, {0, 0, 1, 0, 0, 1, 0, 1, 0}});
  EXPECT_NE(encode_obj(mesh).find("\nvn 0 1 0\nf 1//1 2//2 3//3\n"), std::string::npos);
  mesh.arrays.push_back({"blender.uv", MeshPlace::point, 2, {0, 0.5, 1, 0.5, 0.25, 1}});
  EXPECT_EQ(encode_obj(mesh), "# written by Sheet\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.5\nvt 1 0.5\nvt 0.25 1\nvn 0 0 1\n"
                              "vn 0 0 1\nvn 0 1 0\nf 1/1/1 2/2/2 3/3/3\n");
  EXPECT_EQ(import_mesh(encode_obj(mesh), MeshFormat::obj, "file").mesh.points, mesh.points);
  mesh.arrays.erase(mesh.arrays.begin());
  EXPECT_NE(encode_obj(mesh).find("\nf 1/1 2/2 3/3\n"), std::string::npos);
}

} // namespace
} // namespace sheet::formats
