// SPDX-License-Identifier: GPL-3.0-or-later
// What --check says of scenes with heat, by closed forms.
#include "libsheet/scene/explain_heat.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/frame_heat.h"
#include "libsheet/sheet/sheet.h"
#include "tests/unit/scene/scenes.h"

namespace sheet::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Scene pane(const std::string& heat, const std::string& law = "") {
  return parse_scene("[sheet]\nshape = \"disk\"\nradius = 0.1\nedge_length = 0.02\nthickness = 0.004\n"
                     "[material]\ndensity = 2500\nviscosity = 1e4\nreference_temperature = 1100\n" +
                         (law.empty() ? "viscosity_law = \"exponential\"\ntemperature_coefficient = 0.03\n" : law) +
                         "[environment]\ngravity = [0, -10, 0]\n[heat]\nspecific_heat = 1200\nconductivity = 1.5\n"
                         "temperature = 1100\n" +
                         heat,
                     "s");
}

DimensionlessNumber number_of(const Scene& scene, std::string_view name) {
  const Scales scales = scales_of_sheets(as_it_starts(scene), {}).front();
  for (DimensionlessNumber& number : heat_numbers(scene, scales))
    if (number.name == name)
      return number;
  return {name, "", std::numeric_limits<double>::quiet_NaN(), ""};
}

TEST(ExplainHeat, NamesAStartThatWasMeantInCelsius) {
  const auto warnings = [](std::string text) {
    text.erase(text.rfind("0\n"), 1);
    return explain(parse_scene(text, "s")).warnings;
  };
  const std::string text = "[sheet]\nshape = \"disk\"\nradius = 0.1\nedge_length = 0.02\nthickness = 0.004\n"
                           "[material]\ndensity = 2500\nviscosity = 10\n[environment]\ngravity = [0, -10, 0]\n"
                           "[heat]\nspecific_heat = 1200\ntemperature = 1100\n";
  EXPECT_THAT(warnings(text), testing::Contains("heat.temperature is 110 K, -163.1 degC: a plain number is in K"));
  EXPECT_THAT(explain(parse_scene(text, "s")).warnings, Not(testing::Contains(HasSubstr("plain number"))));
}

TEST(ExplainHeat, SaysNothingWhereThereIsNone) {
  const Scene scene = parse_scene(disk + liquid, "s");
  const Scales scales = scales_of_sheets(scene, {}).front();
  EXPECT_THAT(heat_scales(scene, scales), IsEmpty());
  EXPECT_THAT(heat_numbers(scene, scales), IsEmpty());
  EXPECT_EQ(as_it_starts(scene), scene);
}

TEST(ExplainHeat, TimesAndNumbersByTheirFormulas) {
  const Scene scene = pane("ambient = 300\ntransfer = 20\nemissivity = 0.8\n"
                           "[[solid]]\nshape = \"plane\"\ntemperature = 500\ncontact_conductance = 400\n");
  const double slope = 2 * (20 + 4 * 0.8 * 5.670374419e-8 * std::pow(1100, 3)), c = 2500 * 1200 * 0.004;
  const Scales scales = scales_of_sheets(as_it_starts(scene), {}).front();
  const std::vector<Scale> list = heat_scales(scene, scales);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_NEAR(list[0].value, c / slope, 1e-9 * c / slope);
  EXPECT_NEAR(list[1].value, c / 400, 1e-9 * c / 400);
  EXPECT_NEAR(number_of(scene, "Biot").value, slope / 2 * 0.004 / (2 * 1.5), 1e-9);
  EXPECT_NEAR(number_of(scene, "Peclet").value, 2500.0 * 1200 * scales.speed * *scales.length / 1.5, 1e-3);
  EXPECT_NEAR(std::log(number_of(scene, "range of viscosity").value), 0.03 * 800, 1e-6);
  EXPECT_THAT(number_of(scene, "range of viscosity").meaning, HasSubstr("will hardly move"));
  EXPECT_TRUE(std::isnan(number_of(scene, "Nahme").value));
  const Scene heated = pane("viscous_heating = true\n");
  const double viscous = 0.03 * 1e4 * scales.speed * scales.speed / 1.5;
  EXPECT_NEAR(number_of(heated, "Nahme").value, viscous, 1e-6 * viscous);
}

TEST(ExplainHeat, WarnsOfFacesThatAParabolaDoesNotFollow) {
  const auto warned = [](const std::string& heat) { return explain(pane(heat)).warnings; };
  const auto modes = HasSubstr("profile = 3 in [heat]");
  EXPECT_THAT(warned("ambient = 300\ntransfer = 1000\n"), testing::Contains(modes)); // Biot 1000 0.004/(2 1.5) = 1.33
  EXPECT_THAT(warned("ambient = 300\ntransfer = 1000\nprofile = 3\n"), Not(testing::Contains(modes)));
  EXPECT_THAT(warned("ambient = 300\ntransfer = 700\n"), Not(testing::Contains(modes)));
}

TEST(ExplainHeat, SolidsCountWithAllOfTheThickness) {
  const auto plate = [](const std::string& heat, const std::string& solid) {
    return pane(heat + "[[solid]]\nshape = \"plane\"\n" + solid);
  };
  const std::string warm = "temperature = 1300\ncontact_conductance = 400\n";
  EXPECT_NEAR(number_of(plate("", warm), "Biot on solids").value, 400 * 0.004 / 1.5, 1e-9);
  EXPECT_TRUE(std::isnan(number_of(plate("", ""), "Biot on solids").value));
  const auto modes = HasSubstr("the Biot number on solids is 1.07: what touches them");
  EXPECT_THAT(explain(plate("", warm)).warnings, testing::Contains(modes));
  EXPECT_THAT(explain(plate("profile = 3\n", warm)).warnings, Not(testing::Contains(modes)));
  EXPECT_THAT(explain(plate("", "temperature = 1300\ncontact_conductance = 300\n")).warnings,
              Not(testing::Contains(HasSubstr("Biot"))));
}

TEST(ExplainHeat, SurroundingsThatVaryCountByTheirExtremes) {
  const Scene scene = pane("ambient = {along = \"x\", rows = [[0, 600], [1, 1300]]}\ntransfer = [[0, 5], [3, 20]]\n");
  EXPECT_NEAR(std::log(number_of(scene, "range of viscosity").value), 0.03 * 500, 1e-6);
  EXPECT_THAT(number_of(scene, "range of viscosity").meaning, HasSubstr("At 1.3e+03 K, the warmest, 24.8 Pa s."));
  EXPECT_NEAR(number_of(scene, "Biot").value, 20 * 0.004 / (2 * 1.5), 1e-9);
}

TEST(ExplainHeat, ThickOnesWantModesAcross) {
  const std::string crust = "ambient = 300\ntransfer = 2000\n";
  EXPECT_THAT(number_of(pane(crust), "Biot").meaning, HasSubstr("profile = 3"));
  EXPECT_THAT(number_of(pane(crust + "profile = 4\n"), "Biot").meaning,
              HasSubstr("its modes across the thickness follow"));
}

TEST(ExplainHeat, LiquidsAreNotThinnerThanWater) {
  EXPECT_EQ(warning_of_thinning(pane("ambient = 1500\ntransfer = 5\n")), std::nullopt);
  EXPECT_THAT(warning_of_thinning(pane("ambient = 1700\ntransfer = 5\n")).value_or(""),
              HasSubstr("at 1.7e+03 K, the warmest around, the liquid would have 0.000152 Pa s, less than water"));
  EXPECT_EQ(warning_of_thinning(pane("ambient = 1700\n")), std::nullopt); // it brings no heat
  EXPECT_THAT(explain(pane("ambient = 1700\ntransfer = 5\n")).warnings,
              testing::Contains(HasSubstr("less than water")));
}

// Numbers are those of the liquid as it starts.
TEST(ExplainHeat, TheSceneIsJudgedAsItStarts) {
  Scene scene = pane("");
  scene.sheets[0].temperature = 1000.0;
  EXPECT_NEAR(as_it_starts(scene).material.viscosity, 1e4 * std::exp(3), 1e-6 * 1e4 * std::exp(3));
}

TEST(ExplainHeat, TellsWhatFacesDo) {
  EXPECT_EQ(heat_in_words(pane("ambient = 300\ntransfer = 20\n")),
            "from 1.1e+03 K, both faces cool by air, heat spreads along the sheet; viscosity by exponential");
  EXPECT_THAT(heat_in_words(pane("lower = {ambient = 300, emissivity = 0.5}\n")),
              HasSubstr("the lower face cools by radiation"));
}

TEST(FrameHeat, AFrameMustHaveWhatItsSceneIsAbout) {
  const Scene scene = pane("");
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  formats::Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}}, std::vector<double>{0.1});
  const auto refused = [&] {
    try {
      check_temperatures(scene, frame);
      return std::string("fine");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refused(), HasSubstr("make the first frame with sheet-init"));
  put_temperatures(std::vector<double>{900}, frame);
  EXPECT_EQ(refused(), "fine");
  put_temperatures(std::vector<double>{1e6}, frame);
  EXPECT_THAT(refused(), HasSubstr("1e+06 K is too warm"));
  EXPECT_NO_THROW(check_temperatures(parse_scene(disk + liquid, "s"), frame));
}

} // namespace
} // namespace sheet::scene
