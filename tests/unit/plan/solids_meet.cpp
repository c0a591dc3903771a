// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/solids_meet.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

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

// A curtain 20 cm wide whose upper edge is at a height of 30 cm.
Scene curtain(const std::string& rest) {
  return scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [0.2, 0.1]\nedge_length = 0.01\nthickness = 0.002\n"
      "center = [0, 0.25, 0]\n[material]\nviscosity = 10\ndensity = 1400\n" +
          rest,
      "s");
}
std::vector<std::string> curtain_warnings(const std::string& rest, double until = 1) {
  const Scene scene = curtain(rest);
  return warnings_of_solids_that_meet_what_is_held(scene, first_frame(scene), until);
}

const std::string nozzle = "[inflow]\nregion = \"y_max\"\nvelocity = [0, -0.3, 0]\n";
const std::string moving_box = "[[solid]]\nshape = \"box\"\nsize = [0.05, 0.05, 0.05]\nvelocity = [0.5, 0, 0]\n";

TEST(SolidsMeet, ABoxThatGoesThroughANozzle) {
  const auto told = curtain_warnings(nozzle + moving_box + "center = [-0.225, 0.3, 0]\n"); // 10 cm before it
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("the inlet of inflow 0 and solid 0 (box) move into each other, from 0.2 s on and by "
                                 "up to 0.025 m"));
  EXPECT_TRUE(curtain_warnings(nozzle + moving_box + "center = [-0.225, 0.2, 0]\n").empty()); // below it
  EXPECT_TRUE(curtain_warnings(nozzle + "until = 0.1\n" + moving_box + "center = [-0.225, 0.3, 0]\n").empty());
}

TEST(SolidsMeet, AClipThatIsLoweredIntoATable) {
  const std::string table = "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\n[[hold]]\nregion = \"y_max\"\n";
  const std::string down = "motion = {kind = \"translating\", velocity = [0, -0.5, 0]}\n";
  const auto told = curtain_warnings(table + down);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], HasSubstr("what [[hold]] number 0 (from 0) holds and solid 0 (plane) move into each other, from "
                                 "0.6"));
  EXPECT_TRUE(curtain_warnings(table).empty());
  EXPECT_TRUE(curtain_warnings(table + down, 0.5).empty());
  EXPECT_TRUE(curtain_warnings(table + down + "axes = \"xz\"\n").empty());
  const Scene scene = curtain(table + down + "[environment]\ngravity = [0, -9.81, 0]\n");
  const auto meet = hold_in_solid(scene, first_frame(scene), 1);
  ASSERT_TRUE(meet);
  EXPECT_EQ(meet->hold, 0U);
  EXPECT_EQ(meet->solid, 0U);
  EXPECT_NEAR(meet->time, 0.6, 0.01);
  EXPECT_FALSE(hold_in_solid(scene, first_frame(scene), 0.5));
  EXPECT_LE(proposed_ring(scene, first_frame(scene), {}).until, 0.55);
  EXPECT_THAT(ring_text(scene, first_frame(scene), {}, "init"),
              HasSubstr("[[hold]] 0 (from 0) and solid 0 (plane) move "
                        "into each other at about 0.6"));
}

} // namespace
} // namespace sheet
