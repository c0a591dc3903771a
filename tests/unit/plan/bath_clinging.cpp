// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/bath_clinging.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of a sheet of 40 mm by 40 mm, 1 mm thick, so placed.
std::string clinging(const std::string& placed, const std::string& clings = "true") {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.04, 0.04]\nedge_length = 0.01\nthickness = 0.001\n" + placed +
          "[material]\nviscosity = 5\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n"
          "bath = {density = 1000, level = 0, clings = " +
          clings + "}\n",
      "s");
  return bath_clinging_warning(scene, first_frame(scene));
}

TEST(BathClinging, PullsDownWhatIsAboveIt) {
  EXPECT_THAT(clinging("plane = \"xy\"\n"), testing::HasSubstr("up to 0.02 m above the bath, which clings"));
  EXPECT_THAT(clinging("center = [0, 0.1, 0]\n"), testing::HasSubstr("by 9.8e+02 Pa there"));
  EXPECT_EQ(clinging("plane = \"xy\"\n", "false"), "");
  EXPECT_EQ(clinging("center = [0, 0.002, 0]\n"), "");
}

} // namespace
} // namespace sheet
