// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/beside_walls.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of a layer of 0.6 m by 0.4 m, 0.1 m thick, between two boards that are so far from it. At both sides it loses a
// strip of 25 mm less that, of 0.4 m.
std::string beside(double gap, const std::string& normal = "0", const std::string& hold = "",
                   const std::string& contact = "stick") {
  const std::string plane = "[[solid]]\nshape = \"plane\"\ncontact = \"" + contact + "\"\n";
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.6, 0.4]\nedge_length = 0.05\nthickness = 0.1\n"
                  "center = [0, 0.05, 0]\n[material]\nviscosity = 10\ndensity = 1000\n[environment]\n"
                  "gravity = [0, -9.81, 0]\n{0}{1}{0}center = [0, 0.05, {2}]\nnormal = [0, {3}, -1]\n"
                  "{0}center = [0, 0.05, -{2}]\nnormal = [0, {3}, 1]\n",
                  plane, hold, 0.2 + gap, normal),
      "s");
  return beside_walls_warning(scene, first_frame(scene));
}

TEST(BesideWalls, WhatFillsItsFormIsPutOffItsSides) {
  EXPECT_THAT(beside(0),
              testing::AllOf(testing::HasSubstr("0 m from solid 1 (plane) (and from 1 more), upright"),
                             testing::HasSubstr("thickness, 0.013 m, is put"), testing::HasSubstr("14 % thicker")));
  EXPECT_THAT(beside(0.01), testing::HasSubstr("8 % thicker")); // 2 x 15 mm of 400 mm
  EXPECT_EQ(beside(0.013), "");                                 // is as near as it may be
  EXPECT_EQ(beside(0.1), "");
  EXPECT_EQ(beside(0, "1"), ""); // sides that lean bear the layer
  EXPECT_EQ(beside(0, "0", "[[hold]]\nregion = \"rim\"\n"), "");
  EXPECT_EQ(beside(0, "0", "", "flow"), ""); // stays where it is
}

} // namespace
} // namespace sheet
