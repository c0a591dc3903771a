// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/solids_meet.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"

namespace sheet {
namespace {

using testing::HasSubstr;

// Of a layer of 2 mm on a table, and a ball of 8 mm radius.
std::vector<std::string> warnings(const std::string& ball, double until = 1) {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.16, 0.1]\nedge_length = 0.01\nthickness = 0.002\n"
      "center = [0, 0.001, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[[solid]]\nshape = \"plane\"\n"
      "normal = [0, 1, 0]\n[[solid]]\nshape = \"sphere\"\nradius = 0.008\n" +
          ball,
      "s");
  return warnings_of_solids_that_meet(scene, first_frame(scene), until);
}

TEST(SolidsMeet, ABallThatGoesThroughATable) {
  const auto told = warnings("center = [0, 0.018, 0]\nvelocity = [0, -0.02, 0]\n"); // touches it after half a second
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("solid 0 (plane) and solid 1 (sphere) move into each other, from 0.51 s on and by up "
                                 "to 0.01 m"));
}

TEST(SolidsMeet, NothingIsToldOfWhatLeavesRoom) {
  EXPECT_TRUE(warnings("center = [0, 0.018, 0]\nvelocity = [0, -0.02, 0]\n", 0.5).empty());
  EXPECT_TRUE(warnings("center = [-0.1, 0.009, 0]\nvelocity = [0.2, 0, 0]\n").empty());
}

TEST(SolidsMeet, NothingIsToldOfWhatIsOneThingOrStands) {
  EXPECT_TRUE(warnings("center = [0, 0.004, 0]\nvelocity = [0, -0.01, 0]\n").empty()); // its foot is in the table
  EXPECT_TRUE(warnings("center = [0, 0.004, 0]\n").empty());
}

} // namespace
} // namespace sheet
