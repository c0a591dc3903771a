// SPDX-License-Identifier: GPL-3.0-or-later
// What --check says of liquids that are not Newtonian, by closed forms.
#include "libsheet/scene/explain_law.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/layer_scales.h"
#include "scenes.h"

namespace sheet::scene {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// Of the sheets below: rho g [N/m³], their side and thickness [m].
struct Square {
  static constexpr double weight = 1e4, side = 0.1, thickness = 0.01;
};

Scene scene_with(const std::string& law, const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.02\nthickness = 0.01\n"
                     "[material]\ndensity = 1000\nsurface_tension = 0.03\n" +
                         law + "[environment]\ngravity = [0, -10, 0]\n" + more,
                     "s");
}
Scales scales_of(const Scene& scene) { return scales_of_sheets(scene, {}).front(); }

const std::string bingham_liquid = "law = \"bingham\"\nviscosity = 100\nyield_stress = 200\n";
const std::string power_liquid = "law = \"power\"\nviscosity = 400\nflow_index = 0.5\n";
const std::string slope = "[[solid]]\nshape = \"plane\"\nnormal = [3, 4, 0]\ncontact = \"flow\"\n";

DimensionlessNumber number(const Scene& scene, std::string_view name) {
  const std::vector<DimensionlessNumber> all = numbers_of_law(scene, scales_of(scene));
  const auto found = std::ranges::find(all, name, &DimensionlessNumber::name);
  return found == all.end() ? DimensionlessNumber{name, "", 0, ""} : *found;
}

TEST(ExplainLaw, SaysNothingOfNewtonianLiquids) {
  const Scene scene = scene_with("viscosity = 100\n", slope);
  EXPECT_THAT(law_in_words(scene.material), IsEmpty());
  EXPECT_THAT(scales_of_law(scene, scales_of(scene)), IsEmpty());
  EXPECT_THAT(numbers_of_law(scene, scales_of(scene)), IsEmpty());
  EXPECT_EQ(scales_of(scene).viscosity, 100);
}

TEST(ExplainLaw, TheRateIsThatOfTheStressThatDrives) {
  // rho g L = 1000 Pa: Bingham (1000 - 200)/100 = 8 1/s, 125 Pa s; power (1000/400)² = 6.25 1/s, 160 Pa s
  const Scales bingham = scales_of(scene_with(bingham_liquid + "", "")), power = scales_of(scene_with(power_liquid));
  EXPECT_NEAR(bingham.speed, 8 * Square::side, 1e-4);
  EXPECT_NEAR(bingham.viscosity, 125, 1e-2);
  EXPECT_NEAR(power.speed, 6.25 * Square::side, 1e-6);
  EXPECT_NEAR(power.viscosity, 160, 1e-4);
  const std::vector<Scale> list = scales_of_law(scene_with(power_liquid), power);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_NEAR(list[0].value, 160, 1e-4);
}

TEST(ExplainLaw, ALayerRunsByItsLawAndStandsBelowItsYieldStress) {
  // stress at the wall rho h (0.6 g + g h/L) = 70 Pa; power law: G = (70/400)², u = n/(2 n + 1) G h
  const auto layer_of = [](const std::string& law) {
    const Scene scene = scene_with(law, slope);
    return *layer_scales_of(scene, scales_of(scene));
  };
  const double stress = Square::weight * Square::thickness * (0.6 + Square::thickness / Square::side);
  EXPECT_NEAR(layer_of(power_liquid).stress, stress, 1e-9);
  EXPECT_NEAR(layer_of(power_liquid).speed, 0.25 * std::pow(stress / 400, 2) * Square::thickness, 1e-8);
  EXPECT_EQ(layer_of(bingham_liquid).speed, 0);
  EXPECT_NEAR(layer_of("viscosity = 100\n").speed, stress * Square::thickness / 300, 1e-12);
}

TEST(ExplainLaw, SaysWhatStandsAndWhatFlows) {
  const Scene scene = scene_with(bingham_liquid, slope);
  EXPECT_NEAR(number(scene, "weight against yield").value, Square::weight * Square::side / 200, 1e-9);
  EXPECT_THAT(number(scene, "weight against yield").meaning, HasSubstr("= 0.0346 m hangs: 0.1 m flow"));
  EXPECT_NEAR(number(scene, "layer against yield").value, 60.0 / 200, 1e-9);
  EXPECT_THAT(number(scene, "layer against yield").meaning,
              HasSubstr("a layer of 0.01 m stands; below tau_y / (rho g_t) = 0.0333 m it stands"));
  EXPECT_NEAR(number(scene, "tension against yield").value, 0.03 / (200 * Square::thickness), 1e-12);
  EXPECT_NEAR(number(scene, "Bingham").value, 200 / (100 * 8.0), 1e-4);
  const Scene level = scene_with(bingham_liquid, "[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n");
  EXPECT_NEAR(number(level, "layer against yield").value, 10.0 / 200, 1e-9);
  EXPECT_THAT(number(level, "layer against yield").meaning,
              HasSubstr("stands; below sqrt(tau_y L / (rho g)) = 0.0447"));
  const Scene soft = scene_with("law = \"bingham\"\nviscosity = 100\nyield_stress = 2\n", slope);
  EXPECT_THAT(number(soft, "layer against yield").meaning, HasSubstr("a layer of 0.01 m flows"));
  EXPECT_THAT(number(soft, "tension against yield").meaning, HasSubstr("draws a rim back"));
}

TEST(ExplainLaw, NothingIsDrivenWhereTheYieldStressBearsIt) {
  const auto speed = [](double yield) {
    return scales_of(scene_with("law = \"bingham\"\nviscosity = 100\nyield_stress = " + std::to_string(yield) + "\n"))
        .speed;
  };
  EXPECT_EQ(speed(1000 / std::sqrt(3) + 1), 0); // rho g L = 1000 Pa
  EXPECT_GT(speed(1000 / std::sqrt(3) - 1), 0);
}

TEST(ExplainLaw, ThinningIsThatOverTheRatesOfTheScene) {
  EXPECT_NEAR(number(scene_with(power_liquid), "thinning").value, std::sqrt(10), 1e-6);
  EXPECT_THAT(number(scene_with(power_liquid), "thinning").meaning, HasSubstr("falls from 506 to 160 Pa s"));
  const std::string slow = "law = \"carreau\"\nzero_viscosity = 100\ntime_constant = 0.001\nflow_index = 0.5\n";
  EXPECT_THAT(number(scene_with(slow), "thinning").meaning, HasSubstr("as good as Newtonian"));
}

TEST(ExplainLaw, WarnsOfPowerLawsThatAreNewtonianInTheScene) {
  const auto warning = [](const std::string& law) {
    const Scene scene = scene_with(law);
    return warning_of_rest_rate(scene, scales_of(scene)).value_or("");
  };
  const std::string ice = "law = \"power\"\nflow_index = 0.3333\n"; // 1.5e8 Pa s^(1/3): 3e-16 1/s under 1000 Pa
  EXPECT_THAT(warning(ice + "viscosity = 1.5e8\n"), HasSubstr("give viscosity at a reference_rate"));
  EXPECT_THAT(warning(ice + "viscosity = 1.5e18\nreference_rate = 1e-15\n"), IsEmpty());
  EXPECT_THAT(warning(power_liquid), IsEmpty());
}

TEST(ExplainLaw, TellsEveryLawInWords) {
  const auto words = [](const std::string& law) { return law_in_words(scene_with(law).material); };
  EXPECT_EQ(words(bingham_liquid), "Bingham: stands below 200 Pa; what is above flows with 100 Pa s");
  EXPECT_EQ(words(power_liquid), "power law: 400 Pa s at 1 1/s, falling as rate^-0.5");
  EXPECT_EQ(words("law = \"casson\"\nviscosity = 6\nyield_stress = 29\n"),
            "Casson: stands below 29 Pa, thins towards 6 Pa s");
  EXPECT_EQ(words("law = \"herschel_bulkley\"\nviscosity = 5\nflow_index = 1.5\nyield_stress = 10\n"),
            "Herschel-Bulkley: stands below 10 Pa; what is above flows with 5 Pa s at 1 1/s, rising as rate^0.5");
  EXPECT_EQ(words("law = \"cross\"\nzero_viscosity = 20\ntime_constant = 0.2\nflow_index = 0.4\n"),
            "Cross: 20 Pa s where slow, falling as rate^-0.6 beyond 5 1/s");
  EXPECT_EQ(words("law = \"carreau\"\nzero_viscosity = 20\ninfinite_viscosity = 1\ntime_constant = 0.2\nflow_index = "
                  "0.4\n"),
            "Carreau: 20 Pa s where slow, falling as rate^-0.6 beyond 5 1/s to 1 Pa s");
  EXPECT_EQ(words("law = \"table\"\nrates = [0.1, 1, 10, 100]\nviscosities = [20, 15, 6, 2]\n"),
            "table: 20 Pa s at 0.1 1/s to 2 Pa s at 100 1/s, in 4 rows");
}

} // namespace
} // namespace sheet::scene
