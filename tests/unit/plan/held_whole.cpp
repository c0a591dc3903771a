// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/held_whole.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

std::string warning_of_holds(const std::string& holds) {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.1]\nedge_length = 0.02\n"
                                         "thickness = 0.001\n[material]\nviscosity = 10\ndensity = 1000\n" +
                                             holds,
                                         "s");
  return held_whole_warning(scene, first_frame(scene));
}

TEST(HeldWhole, WhereNothingIsFree) {
  const std::string all = "[[hold]]\nregion = {box = [[-1, -1, -1], [1, 1, 1]]}\n",
                    left = "[[hold]]\nregion = {box = [[-1, -1, -1], [0, 1, 1]]}\n",
                    right = "[[hold]]\nregion = {box = [[0, -1, -1], [1, 1, 1]]}\n";
  EXPECT_THAT(warning_of_holds(all), testing::HasSubstr("holds every vertex of the sheet"));
  EXPECT_THAT(warning_of_holds(left + right), testing::HasSubstr("holds every vertex of the sheet"));
  EXPECT_EQ(warning_of_holds(""), "");
  EXPECT_EQ(warning_of_holds(left), "");
  EXPECT_EQ(warning_of_holds(all + "axes = \"xz\"\n"), ""); // it falls along y
  EXPECT_EQ(warning_of_holds(all + "until = 1\n"), "");     // then it is let go
  EXPECT_EQ(warning_of_holds(all + "[inflow]\nregion = \"x_min\"\nvelocity = [1, 0, 0]\n"), "");
}

} // namespace
} // namespace sheet
