// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/overlapping.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of two squares of 0.1 m, 3 mm and 5 mm thick, the second one's middle there.
std::string overlap(double x, double y, const std::string& more = "") {
  return overlapping_warning(scene::parse_scene(
      fmt::format("[[sheet]]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.01\nthickness = 0.003\n"
                  "[[sheet]]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.01\nthickness = 0.005\n"
                  "center = [{}, {}, 0]\n{}\n[material]\nviscosity = 10\ndensity = 1000\n",
                  x, y, more),
      "s"));
}

TEST(Overlapping, SheetsThatAreLessApartThanThick) {
  EXPECT_THAT(overlap(0, 0.001), testing::HasSubstr("their middles are 0.001 m apart, and should be 0.004 m"));
  EXPECT_THAT(overlap(0.05, -0.001), testing::HasSubstr("start in each other"));
  EXPECT_EQ(overlap(0, 0.004), "");
  EXPECT_EQ(overlap(0, 0.0035), ""); // nearly
  EXPECT_EQ(overlap(0.101, 0), "");  // side by side
  EXPECT_EQ(overlap(0, 0.001, "enters = 1"), "");
}

} // namespace
} // namespace sheet
