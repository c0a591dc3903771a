// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/bath_crushing.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

std::string crushing(const std::string& shape, const std::string& environment,
                     const std::string& center = "[0, 0, 0]") {
  const Scene scene = scene::parse_scene(
      "[[sheet]]\nname = \"a\"\nshape = \"" + shape + "\"\nradius = 0.04\ncenter = " + center +
          "\nedge_length = 0.02\nthickness = 0.001\n"
          "[[sheet]]\nname = \"b\"\nshape = \"sphere\"\nradius = 0.04\ncenter = [1, 1, 0]\nedge_length = 0.02\n"
          "thickness = 0.001\n[material]\nviscosity = 10\ndensity = 900\n[environment]\ngravity = [0, -9.81, 0]\n" +
          environment,
      "s");
  return bath_crushing_warning(scene, first_frame(scene));
}

TEST(BathCrushing, WhatIsClosedAndEmptyInABath) {
  const std::string bath = "bath = {density = 1000}\n", gas = "pressure = {law = \"gas\", value = 0";
  EXPECT_THAT(crushing("sphere", bath), testing::HasSubstr("the bath crushes what is closed and has no gas in it"));
  EXPECT_EQ(crushing("sphere", ""), "");
  EXPECT_EQ(crushing("disk", bath), "");
  EXPECT_EQ(crushing("sphere", bath, "[0, 1, 0]"), "");
  EXPECT_EQ(crushing("sphere", bath + gas + "}\n"), "");
  EXPECT_EQ(crushing("sphere", bath + gas + ", sheet = \"a\"}\n"), "");
  EXPECT_NE(crushing("sphere", bath + gas + ", sheet = \"b\"}\n"), "");
}

} // namespace
} // namespace sheet
