// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cpp/mesh_import.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace sheet::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string seed(const std::string& name) {
  std::ifstream file(std::string(SHEET_SOURCE_DIR "/tests/fuzz/seeds/") + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

MeshImport import_seed(const std::string& name) { return import_mesh(seed(name), *mesh_format_of(name), name); }

std::string error_of(const std::string& bytes, MeshFormat format) {
  try {
    (void)import_mesh(bytes, format, "file");
  } catch (const MeshFileError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("file: "));
    EXPECT_EQ(error.kind(), MeshFileError::Kind::content);
    return error.what();
  }
  return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MeshImport, EveryFormatGivesTheSameSquare) {
  for (const char* name : {"import_obj/square.obj", "import_off/square.off"}) {
    const ForeignMesh mesh = import_seed(name).mesh;
    ASSERT_EQ(mesh.points.size(), 4U) << name;
    EXPECT_THAT(mesh.points[2], ElementsAre(1, 1, 0));
    EXPECT_THAT(mesh.triangles[0], ElementsAre(0, 1, 2)) << name;
  }
  EXPECT_THAT(import_seed("import_obj/square.obj").mesh.triangles[1], ElementsAre(0, 2, 3)); // by negative indices
  for (const char* name : {"import_stl/ascii.stl", "import_stl/binary.stl"}) {
    const ForeignMesh mesh = import_seed(name).mesh;
    EXPECT_EQ(mesh.points.size(), 4U) << name; // merged
    EXPECT_THAT(mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(1, 3, 2))) << name;
  }
}

TEST(MeshImport, PolygonsBecomeFans) {
  EXPECT_THAT(import_seed("import_obj/quad.obj").mesh.triangles,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
  EXPECT_THAT(import_seed("import_off/color.off").mesh.triangles,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
}

double area_of(const ForeignMesh& mesh) { // in the plane of x and y
  double twice = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    const double part = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    EXPECT_GT(part, 0);
    twice += part;
  }
  return twice / 2;
}

// A file of one polygon in each text format that has polygons.
std::vector<std::pair<MeshFormat, std::string>> one_face(const std::vector<std::array<double, 3>>& corners) {
  std::string lines, indices, from_one;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (const double x : corners[i])
      lines += std::to_string(x) + " ";
    lines += "\n";
    indices += " " + std::to_string(i);
    from_one += " " + std::to_string(i + 1);
  }
  const std::string n = std::to_string(corners.size());
  std::string obj = "v " + lines;
  obj.resize(obj.size() - 1);
  for (std::size_t at = obj.find('\n'); at != obj.npos; at = obj.find('\n', at + 1))
    obj.insert(at + 1, "v ");
  return {{MeshFormat::obj, obj + "\nf" + from_one + "\n"},
          {MeshFormat::off, "OFF\n" + n + " 1 0\n" + lines + n + indices + "\n"},
          {MeshFormat::ply, "ply\nformat ascii 1.0\nelement vertex " + n +
                                "\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
                                "property list uchar int vertex_indices\nend_header\n" +
                                lines + n + indices + "\n"}};
}

TEST(MeshImport, ConcavePolygonsKeepTheirArea) {
  const std::vector<std::array<double, 3>> star{{0, 1, 0},       {-0.2, 0.3, 0}, {-1, 0.3, 0},   {-0.3, -0.1, 0},
                                                {-0.6, -0.9, 0}, {0, -0.4, 0},   {0.6, -0.9, 0}, {0.3, -0.1, 0},
                                                {1, 0.3, 0},     {0.2, 0.3, 0}};
  const std::vector<std::array<double, 3>> with_corners_in_a_line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                                                  {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  const std::vector<std::array<double, 3>> around_a_hole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                                                         {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
  for (const auto& [corners, area] :
       {std::pair(star, 1.08), std::pair(with_corners_in_a_line, 3.0), std::pair(around_a_hole, 8.0)})
    for (std::size_t first = 0; first < corners.size(); ++first) {
      auto turned = corners;
      std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(first));
      for (const auto& [format, bytes] : one_face(turned)) {
        const MeshImport import = import_mesh(bytes, format, "file");
        EXPECT_NEAR(area_of(import.mesh), area, 1e-12) << bytes;
        EXPECT_EQ(import.mesh.triangles.size(), corners.size() - 2) << bytes;
      }
    }
}

TEST(MeshImport, PolygonsThatNoTrianglesFillAreRefused) {
  const std::vector<std::array<double, 3>> bow_tie{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<double, 3>> pentagram{
      {0, 1, 0}, {-0.6, -0.8, 0}, {1, 0.3, 0}, {-1, 0.3, 0}, {0.6, -0.8, 0}};
  const std::vector<std::array<double, 3>> tent{{0, 0, 0}, {1, 0, 0.5}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0.5}, {0, 2, 0}};
  for (const auto& [corners, fault] :
       {std::pair(bow_tie, "crosses itself"), std::pair(pentagram, "crosses itself"), std::pair(tent, "is not flat")})
    for (const auto& [format, bytes] : one_face(corners))
      EXPECT_THAT(error_of(bytes, format),
                  testing::AllOf(HasSubstr(format == MeshFormat::ply ? "face 0: " : "line "), HasSubstr(fault)));
}

TEST(MeshImport, RepeatedCornersAreDropped) {
  const MeshImport import = import_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 1 2 3 3 4 1\n", "f.obj");
  EXPECT_THAT(import.mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
  EXPECT_THAT(import.notes, ElementsAre(HasSubstr("names a vertex twice")));
}

TEST(MeshImport, MarksOfByteOrderAreSkipped) {
  for (const char* name : {"import_obj/square.obj", "import_off/square.off", "import_ply/ascii.ply",
                           "import_ply/le.ply", "import_stl/ascii.stl", "import_vtu/ascii.vtu"}) {
    const MeshImport plain = import_seed(name);
    const MeshImport marked = import_mesh("\xEF\xBB\xBF" + seed(name), *mesh_format_of(name), name);
    EXPECT_EQ(marked.mesh.points, plain.mesh.points) << name;
    EXPECT_EQ(marked.mesh.triangles, plain.mesh.triangles) << name;
    EXPECT_EQ(marked.notes, plain.notes) << name;
    for (const bool little : {true, false}) {
      std::string utf16 = little ? "\xFF\xFE" : "\xFE\xFF";
      for (const char c : seed(name).substr(0, 200))
        utf16 += little ? std::string{c, '\0'} : std::string{'\0', c};
      EXPECT_THAT(error_of(utf16, *mesh_format_of(name)), HasSubstr("iconv")) << name;
      EXPECT_THAT(error_of(utf16.substr(2), *mesh_format_of(name)), HasSubstr("iconv")) << name;
    }
  }
}

TEST(MeshImport, StlInCapitals) {
  std::string capitals = seed("import_stl/ascii.stl");
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z')
      c = static_cast<char>(c - 'a' + 'A');
  EXPECT_EQ(import_stl(capitals, "f").mesh.triangles, import_seed("import_stl/ascii.stl").mesh.triangles);
}

TEST(MeshImport, ThicknessAndVelocityOfPly) {
  for (const char* name : {"import_ply/ascii.ply", "import_ply/le.ply", "import_ply/be.ply"}) {
    SCOPED_TRACE(name);
    const ForeignMesh mesh = import_seed(name).mesh;
    ASSERT_TRUE(mesh.find("thickness", MeshPlace::point));
    EXPECT_NEAR(mesh.find("thickness", MeshPlace::point)->values.at(3), 0.01, 1e-9);
    EXPECT_THAT(mesh.find("thickness", MeshPlace::cell)->values, ElementsAre(0.1, 0.2, 0.2)); // the quad twice
    EXPECT_THAT(mesh.find("velocity", MeshPlace::point)->values, ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3));
  }
}

TEST(MeshImport, EveryEncodingOfVtu) {
  for (const char* name :
       {"import_vtu/ascii.vtu", "import_vtu/inline.vtu", "import_vtu/raw.vtu", "import_vtu/base64.vtu"}) {
    SCOPED_TRACE(name);
    const ForeignMesh mesh = import_seed(name).mesh;
    EXPECT_THAT(mesh.points[3], ElementsAre(0, 1, 0.5));
    EXPECT_THAT(mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
    EXPECT_NEAR(mesh.find("thickness", MeshPlace::point)->values.at(3), 0.2, 1e-7);
    EXPECT_THAT(mesh.find("thickness", MeshPlace::cell)->values, ElementsAre(0.1, 0.2, 0.2));
    EXPECT_EQ(mesh.find("velocity", MeshPlace::point)->values.at(11), 11.0);
  }
}

TEST(MeshImport, SeveralPiecesOfVtuBecomeOneMesh) {
  const auto piece = [](const std::string& x) {
    return "<Piece NumberOfPoints=\"3\" NumberOfCells=\"2\"><Points><DataArray type='Float32' NumberOfComponents='3'>" +
           x +
           " 0 0 1 0 0 0 1 0</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity'>0 1 2 0</DataArray>"
           "<DataArray type='Int32' Name='offsets'>3 4</DataArray><DataArray type='UInt8' Name='types'>5 1</DataArray>"
           "</Cells><CellData><DataArray type='Float64' Name='thickness'>" +
           x + " 9</DataArray></CellData></Piece>";
  };
  const MeshImport import = import_vtu("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>" + piece("0.25") +
                                           piece("0.5") + "</UnstructuredGrid></VTKFile>",
                                       "file");
  EXPECT_THAT(import.mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4, 5)));
  EXPECT_THAT(import.mesh.find("thickness", MeshPlace::cell)->values, ElementsAre(0.25, 0.5));
  EXPECT_THAT(import.notes, ElementsAre(HasSubstr("2 cells that are points or lines")));
}

TEST(MeshImport, DropsAndTellsWhatIsUseless) {
  const MeshImport import =
      import_off("OFF\n6 4 0\n9 9 9\n0 0 0\n1 0 0\n1 1 0\n2 2 0\n8 8 8\n3 1 2 3\n3 1 1 2\n2 1 2\n3 1 3 4\n", "f.off");
  EXPECT_EQ(import.mesh.points.size(), 4U);
  EXPECT_THAT(import.mesh.triangles, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 2, 3)));
  EXPECT_THAT(import.notes,
              ElementsAre(HasSubstr("fewer than three corners dropped (first: line 11)"),
                          HasSubstr("names a vertex twice; triangles without area dropped (first: line 10)"),
                          HasSubstr("2 vertices that no face uses"), HasSubstr("no area (first: face 3")));
}

TEST(MeshImport, ErrorsNamePlaceAndRemedy) {
  using enum MeshFormat;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(error_of("", obj), HasSubstr("no vertices"));
  EXPECT_THAT(error_of(triangle, obj), HasSubstr("triangulate"));
  EXPECT_THAT(error_of(triangle + "f 1 2 4\n", obj),
              HasSubstr("line 4: vertex index 4 is out of range: the file has 3"));
  EXPECT_THAT(error_of(triangle + "f 1 2 0\n", obj), HasSubstr("line 4"));
  EXPECT_THAT(error_of(triangle + "f 1 2 -4\n", obj), HasSubstr("before the first"));
  EXPECT_THAT(error_of(triangle + "f 1 2 -9223372036854775808\n", obj), HasSubstr("before the first"));
  EXPECT_THAT(error_of(triangle + "f 1 2 9223372036854775807\n", obj), HasSubstr("out of range"));
  EXPECT_THAT(error_of("v 0 0\n", obj), HasSubstr("line 1: a coordinate is missing"));
  EXPECT_THAT(error_of("v 0 0,5 1\n", obj), HasSubstr("decimal point"));
  EXPECT_THAT(error_of("v 0 nan 1\n", obj), HasSubstr("not finite"));
  EXPECT_THAT(error_of("v 0 1e999 1\n", obj), HasSubstr("not a number"));
  EXPECT_THAT(error_of("PLY\n", off), HasSubstr("starts with OFF"));
  EXPECT_THAT(error_of("4OFF\n", off), HasSubstr("three-dimensional"));
  EXPECT_THAT(error_of("OFF BINARY\n", off), HasSubstr("ASCII"));
  EXPECT_THAT(error_of("OFF\n1000000000000 1 0\n0 0 0\n", off), HasSubstr("too short"));
  EXPECT_THAT(error_of("OFF\n3 1 0\n0 0 0\n0 0 1\n", off), HasSubstr("line 4: the file ends after 2 of 3 vertices"));
  EXPECT_THAT(error_of("OFF\n3 1 0\n0 0 0\n0 1 0\n1 0 0\n3 0 1 -1\n", off), HasSubstr("line 6: vertex index -1"));
  EXPECT_THAT(error_of("OFF\n3 1 0\n0 0 0\n0 1 0\n1 0 0\n999999999999 0 1 2\n", off), HasSubstr("missing"));
  EXPECT_THAT(error_of("short", stl), HasSubstr("neither"));
  for (const char* solid : {"solid", "SOLID", "other"})
    EXPECT_THAT(error_of(replaced(seed("import_stl/binary.stl"), "solid", solid).substr(0, 150), stl),
                HasSubstr("184 bytes but has 150"));
  EXPECT_THAT(error_of(replaced(seed("import_stl/ascii.stl"), "outer loop", "outer ring"), stl),
              HasSubstr("line 3: expected 'loop'"));
  EXPECT_THAT(error_of(replaced(seed("import_ply/le.ply"), "vertex 4", "vertex 4000000000"), ply),
              HasSubstr("too short"));
  EXPECT_THAT(error_of(replaced(seed("import_ply/le.ply"), "float vx", "float vq"), ply), HasSubstr("velocity_x"));
  EXPECT_THAT(error_of(replaced(seed("import_ply/le.ply"), "property float x", "property foat x"), ply),
              HasSubstr("foat"));
  EXPECT_THAT(error_of(replaced(seed("import_ply/ascii.ply"), "4 0 1 2 3", "4 0 1 2 7"), ply),
              HasSubstr("face 1: vertex index 7"));
  EXPECT_THAT(error_of(seed("import_ply/be.ply").substr(0, 420), ply), HasSubstr("too short"));
  EXPECT_THAT(
      error_of(replaced(seed("import_vtu/raw.vtu"), "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order"),
               vtu),
      HasSubstr("compression=None"));
  EXPECT_THAT(error_of(replaced(seed("import_vtu/ascii.vtu"), "UnstructuredGrid", "PolyData"), vtu),
              HasSubstr("UnstructuredGrid"));
  EXPECT_THAT(error_of(replaced(seed("import_vtu/ascii.vtu"), ">5 7<", ">10 7<"), vtu), HasSubstr("Extract Surface"));
  EXPECT_THAT(error_of(replaced(seed("import_vtu/ascii.vtu"), ">3 7<", ">3 9<"), vtu), HasSubstr("offset of cell 1"));
  EXPECT_THAT(error_of(replaced(seed("import_vtu/raw.vtu"), "offset=\"0\"", "offset=\"99999\""), vtu),
              HasSubstr("lies behind"));
  EXPECT_THAT(
      error_of(replaced(seed("import_vtu/ascii.vtu"), "NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999\""), vtu),
      HasSubstr("expected 99999999999 tuples"));
}

// No prefix of a file may crash the reader; most are errors, some are smaller meshes.
TEST(MeshImport, EveryPrefixIsSafe) {
  const std::filesystem::path seeds = SHEET_SOURCE_DIR "/tests/fuzz/seeds";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(seeds)) {
    const std::optional<MeshFormat> format = mesh_format_of(entry.path().string());
    if (!format)
      continue;
    ++files;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t n = 0; n < bytes.size(); ++n)
      try {
        const std::string prefix = bytes.substr(0, n); // a copy, so that reading past its end is noticed
        (void)import_mesh(prefix, *format, "file");
      } catch (const MeshFileError&) {
      }
  }
  EXPECT_GE(files, 13U);
}

TEST(MeshImport, FormatFollowsFromTheEnding) {
  EXPECT_EQ(mesh_format_of("a/b.OBJ"), MeshFormat::obj);
  EXPECT_EQ(mesh_format_of("a.vtu"), MeshFormat::vtu);
  EXPECT_EQ(mesh_format_of("a.ply/b"), std::nullopt);
  EXPECT_EQ(mesh_format_of("obj"), std::nullopt);
  try {
    (void)import_mesh("/nonexistent/a.off");
    FAIL();
  } catch (const MeshFileError& error) {
    EXPECT_EQ(error.kind(), MeshFileError::Kind::io);
  }
}

// The meshes of Debian's package libcgal-demo.
TEST(MeshImport, RealMeshes) {
  const std::string archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
  if (!std::filesystem::exists(archive))
    GTEST_SKIP() << archive << " is not installed";
  const std::string folder = testing::TempDir() + "sheet_real_meshes_" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  const auto extract = [&](const std::string& file) {
    return std::system(("tar xzf " + archive + " -C '" + folder + "' data/meshes/" + file).c_str()) == 0;
  };
  struct Case {
    const char* file;
    std::size_t vertices, triangles;
  };
  for (const Case& c : {Case{"bunny00.off", 37706, 75408}, Case{"elephant.off", 2775, 5558},
                        Case{"armadillo.off", 26002, 52000}, Case{"knot1.off", 3200, 6400},
                        Case{"camel.off", 9770, 19536}, Case{"pig.stl", 8642, 16848}, Case{"sphere.ply", 162, 320}}) {
    SCOPED_TRACE(c.file);
    ASSERT_TRUE(extract(c.file));
    const MeshImport import = import_mesh(folder + "/data/meshes/" + c.file);
    EXPECT_EQ(import.mesh.points.size(), c.vertices);
    EXPECT_EQ(import.mesh.triangles.size(), c.triangles);
  }
  std::filesystem::remove_all(folder);
}

TEST(MeshImport, ArraysOfPlyThatAreAskedFor) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "property float s\nproperty float t\nproperty double lab.dye\nproperty double n_x\nproperty "
      "double n_y\nproperty double n_z\nproperty uchar c_0\nproperty uchar c_1\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty int material\nend_header\n"
      "0 0 0 0.5 1 7 1 2 3 4 5\n1 0 0 0.25 2 8 4 5 6 6 7\n0 1 0 0.125 3 9 7 8 9 8 9\n3 0 1 2 -2\n";
  const std::vector<std::string> names{"uv", "lab.dye", "n", "c", "material", "none"};
  const ForeignMesh mesh = import_mesh(text, MeshFormat::ply, "file", names).mesh;
  ASSERT_EQ(mesh.arrays.size(), 5);
  const auto expect = [&](const char* name, MeshPlace place, int components, bool whole, std::vector<double> values) {
    const MeshArray* array = mesh.find(name, place);
    ASSERT_NE(array, nullptr) << name;
    EXPECT_EQ(array->components, components) << name;
    EXPECT_EQ(array->whole, whole) << name;
    EXPECT_EQ(array->values, values) << name;
  };
  expect("uv", MeshPlace::point, 2, false, {0.5, 1, 0.25, 2, 0.125, 3});
  expect("lab.dye", MeshPlace::point, 1, false, {7, 8, 9});
  expect("n", MeshPlace::point, 3, false, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  expect("c", MeshPlace::point, 2, true, {4, 5, 6, 7, 8, 9});
  expect("material", MeshPlace::cell, 1, true, {-2});
  EXPECT_TRUE(import_mesh(text, MeshFormat::ply, "file").mesh.arrays.empty());
}

} // namespace
} // namespace sheet::formats
