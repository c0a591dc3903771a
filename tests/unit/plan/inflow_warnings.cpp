// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/inflow_warnings.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

std::vector<std::string> warnings(const std::string& plane, const std::string& inflow) {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\n"
                                         "thickness = 0.003\nplane = \"" +
                                             plane +
                                             "\"\n[material]\nviscosity = 10\ndensity = 1200\n[environment]\n"
                                             "gravity = [0, -9.81, 0]\n[[inflow]]\nthickness = 0.003\n" +
                                             inflow,
                                         "s");
  return inflow_warnings(scene, first_frame(scene));
}

TEST(InflowWarnings, OfLiquidThatRisesAcrossTheSheet) {
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [0, 0.1, 0]\n"),
              testing::ElementsAre(testing::HasSubstr("inflow 0 goes up out of the sheet")));
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [0.1, 0.05, 0]\n"), testing::IsEmpty());
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [0, -0.1, 0]\n"), testing::IsEmpty()); // a curtain
  EXPECT_THAT(warnings("xy", "region = \"y_min\"\nvelocity = [0, 0.1, 0]\n"), testing::IsEmpty());  // a jet
}

// The inlet is 60 mm wide.
TEST(InflowWarnings, OfOneThatIsThickerThanWide) {
  const auto warnings_of = [](double thickness) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\nthickness = 0.003\n"
                    "[material]\nviscosity = 10\ndensity = 1200\n[inflow]\nregion = \"x_min\"\n"
                    "velocity = [0.1, 0, 0]\nthickness = {}\n",
                    thickness),
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(warnings_of(3), testing::ElementsAre(testing::StartsWith(
                                  "inflow 0 is thicker (3 m) than wide (0.06 m): it is no sheet; if 3 mm are meant")));
  EXPECT_THAT(warnings_of(0.05), testing::IsEmpty());
}

// 1 mm, 0.1 m/s, from a slot 1 mm above a belt.
TEST(InflowWarnings, OfOneThatABeltDrawsWithinAnEdge) {
  const auto warnings_of = [](double edge, double height, double belt) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.06]\nedge_length = {}\nthickness = 0.001\n"
                    "center = [0, {}, 0]\n[material]\nviscosity = 1\ndensity = 1000\n[environment]\n"
                    "gravity = [0, -9.81, 0]\n[inflow]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n"
                    "[[solid]]\nshape = \"plane\"\nsurface_velocity = [{}, 0, 0]\n",
                    edge, height, belt),
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(
      warnings_of(0.004, 0.001, 0.2),
      testing::ElementsAre(testing::AllOf(
          testing::StartsWith("inflow 0 is drawn by solid 0 (plane) from 0.1 to 0.2 m/s on a way of some 0.001 m"),
          testing::HasSubstr("edge_length = 0.001"))));
  EXPECT_THAT(warnings_of(0.001, 0.001, 0.2), testing::IsEmpty());
  EXPECT_THAT(warnings_of(0.004, 0.005, 0.3), testing::IsEmpty()); // drawn as it falls
  EXPECT_THAT(warnings_of(0.004, 0.001, 0.1), testing::IsEmpty());
}

// A curtain of honey, 20 mm long.
TEST(InflowWarnings, OfASheetThatStartsSlowerThanWhatFlowsIn) {
  const auto warnings_of = [](double start, double enters, double viscosity, const std::string& more = "") {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.03, 0.02]\nedge_length = 0.003\nthickness = 0.002\n"
                    "plane = \"xy\"\nvelocity = [0, {}, 0]\n[material]\nviscosity = {}\ndensity = 1400\n"
                    "[environment]\ngravity = [0, -9.81, 0]\n[inflow]\nregion = \"y_max\"\nthickness = 0.002\n"
                    "velocity = [0, {}, 0]\n{}",
                    start, viscosity, enters, more),
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(warnings_of(0, -0.5, 2),
              testing::ElementsAre("inflow 0 enters at 0.5 m/s, and the sheet starts at 0 m/s along it: it thickens or "
                                   "folds at the inlet before it moves as fast. velocity = [0, -0.5, 0] in [sheet] "
                                   "lets it start so"));
  EXPECT_THAT(warnings_of(-0.5, -0.5, 2), testing::IsEmpty());
  EXPECT_THAT(warnings_of(-1, -0.5, 2), testing::IsEmpty());
  EXPECT_THAT(warnings_of(0, -0.1, 2), testing::IsEmpty());  // gravity soon makes it as fast
  EXPECT_THAT(warnings_of(0, -0.5, 30), testing::IsEmpty()); // it is taken along as a whole
  EXPECT_THAT(warnings_of(0, -0.5, 2, "[model]\ninertia = false\n"), testing::IsEmpty());
}

// Of 0.9 of the bath's density, the middle floats 0.9 thicknesses under the level.
TEST(InflowWarnings, OfOneThatFloatsAtAnotherHeightThanItComesIn) {
  const auto warnings_of = [](const std::string& height, const std::string& velocity) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [2e4, 6e4]\nedge_length = 4e3\nthickness = 600\ncenter = [0, " +
            height +
            ", 0]\n[material]\nviscosity = 1e14\ndensity = 900\n[model]\ninertia = false\n[environment]\n"
            "gravity = [0, -9.81, 0]\nbath = {density = 1000, level = 0}\n[inflow]\nregion = \"x_min\"\n"
            "velocity = " +
            velocity + "\n",
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(warnings_of("0", "[1e-5, 0, 0]"), testing::ElementsAre(testing::HasSubstr("is 540 m lower")));
  EXPECT_THAT(warnings_of("-540", "[1e-5, 0, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("-300", "[1e-5, 0, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("2000", "[1e-5, 0, 0]"), testing::IsEmpty()); // poured on it
  EXPECT_THAT(warnings_of("0", "[1e-5, -1e-5, 0]"), testing::IsEmpty());
}

// Down a slope of 10 degrees, 0.3 m thick: half of that from it, or poured on it from above.
TEST(InflowWarnings, OfOneThatComesInAboveTheSolidAlongWhichItFlows) {
  const auto warnings_of = [](const std::string& height, const std::string& velocity) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [3, 2]\nedge_length = 0.25\nthickness = 0.3\ncenter = [0, " + height +
            ", 0]\nrotation = {axis = [0, 0, 1], angle = \"-10 deg\"}\n[material]\nviscosity = 1000\ndensity = 2600\n"
            "[environment]\ngravity = [0, -9.81, 0]\n[inflow]\nregion = \"x_min\"\nvelocity = " +
            velocity + "\n[[solid]]\nshape = \"plane\"\nnormal = [0.17365, 0.98481, 0]\ncontact = \"flow\"\n",
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(warnings_of("0.3", "[0.3, -0.053, 0]"),
              testing::ElementsAre(testing::AllOf(testing::StartsWith("inflow 0 comes in 0.295 m from solid 0 (plane)"),
                                                  testing::HasSubstr("is 0.145 m nearer"))));
  EXPECT_THAT(warnings_of("0.1523", "[0.3, -0.053, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("0.2", "[0.3, -0.053, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("1", "[0.3, -0.053, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("0.3", "[0.3, -0.3, 0]"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("0.3", "[0.1, -0.0176, 0]"), testing::IsEmpty()); // 0.133 m/s run away
}

} // namespace
} // namespace sheet
