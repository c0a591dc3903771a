// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/holds_meet.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// A strip of 0.1 m between two sides, 2 mm thick, that goes on for ever without inertia.
Scene pressed(const std::string& left, const std::string& right) {
  return scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.02]\nedge_length = 0.005\n"
                            "thickness = 0.002\n[material]\nviscosity = 500\ndensity = 1000\n[model]\n"
                            "inertia = false\n[[hold]]\nregion = \"x_min\"\n" +
                                left + "[[hold]]\nregion = \"x_max\"\n" + right,
                            "s");
}

std::string moved(double velocity) {
  return "motion = {kind = \"translating\", velocity = [" + std::to_string(velocity) + ", 0, 0]}\n";
}

TEST(HoldsMeet, WhenTheSheetHasNoRoomAnyMore) {
  const Scene scene = pressed(moved(0.01), moved(-0.01));
  const auto first = first_frame(scene);
  const auto meet = holds_meet(scene, first, 10);
  ASSERT_TRUE(meet);
  EXPECT_EQ(meet->one, 0u);
  EXPECT_EQ(meet->other, 1u);
  EXPECT_NEAR(meet->time, (0.1 - 0.002) / 0.02, 0.01);
  EXPECT_FALSE(holds_meet(scene, first, 4.8));
  EXPECT_EQ(proposed_ring(scene, first, {}).until, 4.4);
  EXPECT_EQ(proposed_ring(scene, first, {Quality::normal, 6.0, {}}).until, 6);
  EXPECT_THAT(ring_text(scene, first, {}, "i"),
              testing::HasSubstr("[[hold]]s 0 and 1 (from 0) come together at about 4.9 s, with no room between them: "
                                 "end before, at 4.4 s"));
}

TEST(HoldsMeet, NotWhereTheyGoPastOrStopOrPart) {
  const auto meet = [](const std::string& left, const std::string& right) {
    const Scene scene = pressed(left, right);
    return holds_meet(scene, first_frame(scene), 100).has_value();
  };
  EXPECT_TRUE(meet(moved(0.01), ""));
  EXPECT_FALSE(meet(moved(-0.01), ""));
  EXPECT_FALSE(meet("motion = {kind = \"translating\", velocity = [0.01, 0.002, 0]}\n", ""));
  EXPECT_FALSE(meet(moved(0.01) + "until = 5\n", ""));
  EXPECT_FALSE(
      meet("motion = {kind = \"translating\", velocity = [[0, 0.01, 0, 0], [5, 0.01, 0, 0], [5.1, 0, 0, 0]]}\n", ""));
  EXPECT_TRUE(meet(moved(0.01) + "axes = \"xz\"\n", "axes = \"xy\"\n"));
  EXPECT_FALSE(meet(moved(0.01) + "axes = \"xz\"\n", "axes = \"y\"\n"));
}

} // namespace
} // namespace sheet
