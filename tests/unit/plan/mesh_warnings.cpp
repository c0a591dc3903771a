// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/mesh_warnings.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"
#include "tests/unit/own_path.h"

namespace sheet {
namespace {

std::vector<std::string> warnings_of(const std::string& thickness, const std::string& solids) {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.01\ncenter = [0, 0.1, 0]\nthickness = " +
          thickness + "\n[material]\nviscosity = 1\ndensity = 1000\n" + solids,
      "s");
  return mesh_warnings(scene, checked_first_frame(scene));
}

TEST(MeshWarnings, OfSolidsNarrowerThanEdges) {
  const std::string tooth = "[[solid]]\nshape = \"capsule\"\nradius = 0.002\nlength = 0.1\n",
                    ball = "[[solid]]\nshape = \"sphere\"\nradius = 0.03\n", thin = "0.001";
  EXPECT_TRUE(warnings_of(thin, ball).empty());
  EXPECT_TRUE(warnings_of(thin, "[[solid]]\nshape = \"sphere\"\nradius = 0.0095\n").empty()); // about as wide
  const auto one = warnings_of(thin, ball + tooth);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].starts_with("solid 1 (capsule) is narrower (0.002 m) than edges are long (")) << one[0];
  EXPECT_TRUE(one[0].ends_with("triangles span it instead of lying on it: edge_length = 0.002 in [sheet]")) << one[0];
  const auto two = warnings_of("0.005", tooth + tooth);
  ASSERT_EQ(two.size(), 1u);
  EXPECT_TRUE(two[0].starts_with("solid 0 (capsule) and 1 more are narrower")) << two[0];
  EXPECT_TRUE(two[0].ends_with("a groove that it draws within the layer is not modelled")) << two[0];
}

// Of a mesh edge_length would be refused.
TEST(MeshWarnings, RemedyOfLongEdgesIsOneThatTheSceneTakes) {
  std::string scene = "[sheet]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 0.1\nthickness = 0.01\n"
                      "[material]\nviscosity = 1\ndensity = 1000\n";
  EXPECT_EQ(setting_of_edges(scene::parse_scene(scene, "s"), 0.012), "edge_length = 0.012 in [sheet]");
  const std::string file = test::own_path("one.obj");
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  scene = "[sheet]\nshape = \"mesh\"\nfile = \"" + file +
          "\"\nthickness = 0.01\n[material]\nviscosity = 1\ndensity = 1000\n";
  EXPECT_EQ(setting_of_edges(scene::parse_scene(scene, "s"), 0.012), "sheet-remesh --edge-length 0.012 in the ring");
}

// The corners of a box, numbered from `first` on, and its faces, in the words of an OBJ file.
std::string obj_box(int first, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  constexpr std::array sides{std::array{0, 1, 3, 2}, std::array{4, 6, 7, 5}, std::array{0, 4, 5, 1},
                             std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 5, 7, 3}};
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", (i & 4) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                        (i & 1) != 0 ? high.z() : low.z());
  for (const auto& face : sides) {
    text += "f";
    for (const int corner : face)
      text += fmt::format(" {}", first + corner);
    text += "\n";
  }
  return text;
}

// A file's path in quotes.
std::string file_with(const std::string& name, const std::string& text) {
  const std::string path = test::own_path(name);
  std::ofstream(path) << text;
  return "\"" + path + "\"";
}

// A stool: its seat is 40 mm wide, its legs are 4 mm wide.
TEST(MeshWarnings, OfMeshesWithPartsNarrowerThanEdges) {
  const std::string seat = obj_box(1, {-0.02, 0.04, -0.02}, {0.02, 0.044, 0.02}),
                    legs = obj_box(9, {-0.018, 0, -0.018}, {-0.014, 0.0399, -0.014}) +
                           obj_box(17, {0.014, 0, 0.014}, {0.018, 0.0399, 0.018});
  const auto solid = [](const std::string& file) { return "[[solid]]\nshape = \"mesh\"\nfile = " + file + "\n"; };
  EXPECT_TRUE(warnings_of("0.001", solid(file_with("seat.obj", seat))).empty());
  const auto stool = warnings_of("0.001", solid(file_with("stool.obj", seat + legs)));
  ASSERT_EQ(stool.size(), 1U);
  EXPECT_THAT(stool[0], testing::HasSubstr("stool.obj) is in parts narrower (0.004 m) than edges"));
}

// Of 40 m, a sheet of 0.1 m lies on it, or one of 10 m.
TEST(MeshWarnings, OfMeshesThatMayBeInMillimetres) {
  const std::string solid =
      "[[solid]]\nshape = \"mesh\"\nfile = " + file_with("hill.obj", obj_box(1, {-20, -30, -20}, {20, -10, 20})) + "\n";
  EXPECT_THAT(warnings_of("0.001", solid),
              testing::ElementsAre(testing::HasSubstr("hill.obj) is 60 m long: if its mesh is in millimetres")));
  const Scene large = scene::parse_scene("[sheet]\nshape = \"disk\"\nradius = 5\nedge_length = 1\nthickness = 0.5\n"
                                         "[material]\nviscosity = 1000\ndensity = 2000\n" +
                                             solid,
                                         "s");
  EXPECT_TRUE(mesh_warnings(large, checked_first_frame(large)).empty());
}

// Each triangle has vertices of its own.
TEST(MeshWarnings, ASheetWithSeamsIsRefusedWhereItIsToKeepApart) {
  const std::string soup = file_with("soup.obj", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\n"
                                                 "f 1 2 3\nf 4 5 6\n");
  const auto scene = [&](const std::string& more) {
    return scene::parse_scene("[sheet]\nshape = \"mesh\"\nthickness = 0.01\nfile = " + soup +
                                  "\n[material]\nviscosity = 1\ndensity = 1000\n" + more,
                              "s");
  };
  constexpr std::string_view text = "2 edges of the sheet's border lie on each other, the first at (0.5, 0, 0.5) m";
  EXPECT_THAT(mesh_warnings(scene(""), checked_first_frame(scene(""))), testing::Contains(testing::StartsWith(text)));
  const Scene apart = scene("[contact]\nself = true\n");
  EXPECT_THAT([&] { (void)checked_first_frame(apart); },
              testing::ThrowsMessage<Error>(testing::StartsWith(std::string(text))));
}

} // namespace
} // namespace sheet
