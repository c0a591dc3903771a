// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/mesh_warnings.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

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
  const auto one = warnings_of(thin, ball + tooth);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].starts_with("solid 1 (capsule) is narrower (0.002 m) than edges are long (")) << one[0];
  EXPECT_TRUE(one[0].ends_with("triangles span it instead of lying on it: edge_length = 0.002 in [sheet]")) << one[0];
  const auto two = warnings_of("0.005", tooth + tooth);
  ASSERT_EQ(two.size(), 1u);
  EXPECT_TRUE(two[0].starts_with("solid 0 (capsule) and 1 more are narrower")) << two[0];
  EXPECT_TRUE(two[0].ends_with("a groove that it draws within the layer is not modelled")) << two[0];
}

} // namespace
} // namespace sheet
