// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/late_heat.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// rho c h/H: 30 s by the pan.
std::string told(const std::string& law, const std::string& inflow, double until) {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.05, 0.05]\nedge_length = 0.01\nthickness = 0.01\n"
      "center = [0, 0.006, 0]\n[material]\nviscosity = 2\ndensity = 1000\n" +
          law +
          "[environment]\ngravity = [0, -9.81, 0]\n[heat]\nspecific_heat = 3000\ntemperature = 293\n"
          "[[solid]]\nshape = \"plane\"\ntemperature = 423\ncontact_conductance = 1000\ncontact = \"flow\"\n" +
          inflow,
      "s");
  return late_heat_warning(scene, first_frame(scene), until);
}

TEST(LateHeat, WhereTheRunEndsBeforeItSets) {
  const std::string law = "viscosity_law = \"exponential\"\nreference_temperature = 293\n"
                          "temperature_coefficient = 0.05\n";
  EXPECT_THAT(told(law, "", 0.4), testing::HasSubstr("the run ends, at 0.4 s, before heat changes how it flows, as "
                                                     "cooling and warming take some 30 s: --until 30 shows that"));
  EXPECT_EQ(told(law, "", 4), "");
  // 6 K more within 1.4 s: of a law ten times as steep its twentieth is left
  EXPECT_NE(told(law, "", 1.4), "");
  EXPECT_EQ(
      told("viscosity_law = \"exponential\"\nreference_temperature = 293\ntemperature_coefficient = 0.5\n", "", 1.4),
      "");
  EXPECT_EQ(told(law, "", 0.02), "");
  EXPECT_EQ(told("", "", 0.4), "");
  EXPECT_EQ(told(law, "[inflow]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n", 0.4), "");
}

} // namespace
} // namespace sheet
