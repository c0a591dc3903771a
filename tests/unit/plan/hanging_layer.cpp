// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging_layer.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using testing::HasSubstr;

const std::string varnish = "viscosity = 1\nsurface_tension = 0.03\n";
const std::string ceiling = "normal = [0, -1, 0]\ncontact = \"flow\"\n";

// Varnish 2 mm thick below a ceiling, for 5 s: its weight is 1e4 N/m³.
std::string hanging(const std::string& plane, const std::string& material = varnish, double radius = 0.04,
                    double until = 5) {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"disk\"\nradius = {}\nedge_length = {}\nthickness = 0.002\n"
                  "center = [0, -0.001, 0]\n[material]\ndensity = 1000\n{}[environment]\ngravity = [0, -10, 0]\n"
                  "[[solid]]\nshape = \"plane\"\n{}",
                  radius, radius / 5, material, plane),
      "s");
  return hanging_layer_warning(scene, first_frame(scene), until);
}

// 2 pi sqrt(2 0.03/1e4) = 15.39 mm, 12 0.03/(1e8 8e-9) = 0.45 s
TEST(HangingLayer, GathersToDropsAsFermigierHasIt) {
  EXPECT_THAT(hanging(ceiling), HasSubstr("the sheet hangs below solid 0 (plane)"));
  EXPECT_THAT(hanging(ceiling), HasSubstr("drops, 0.0154 m apart, which grow by e within 0.45 s"));
  EXPECT_EQ(hanging(ceiling, varnish, 0.04, 0.05), "");
  EXPECT_EQ(hanging(ceiling, varnish, 0.005), ""); // a patch of 8.9 mm
}

// 3/(1e4 0.002) = 0.15 s
TEST(HangingLayer, WithoutTensionGrowsFastestAsNarrowAsItIsThick) {
  EXPECT_THAT(hanging(ceiling, "viscosity = 1\n"), HasSubstr("to drops, which grow by e within 0.15 s"));
}

TEST(HangingLayer, IsNoneThatLiesOrSticksOrYieldsOrTurns) {
  EXPECT_EQ(hanging("normal = [0, 1, 0]\ncenter = [0, -0.002, 0]\ncontact = \"flow\"\n"), "");
  EXPECT_EQ(hanging("normal = [0, -1, 0]\n"), "");
  EXPECT_EQ(hanging(ceiling, varnish + "law = \"bingham\"\nyield_stress = 50\n"), "");
  EXPECT_EQ(hanging(ceiling + "angular_velocity = [0, 1, 0]\n"), "");
}

} // namespace
} // namespace sheet
