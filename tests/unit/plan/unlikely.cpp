// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/unlikely.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> told(const std::vector<std::string>& settings) {
  return unlikely_values(scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.1]\nedge_length = 0.02\n"
                                            "thickness = 0.001\nvelocity = [0, 0.5, 0]\n"
                                            "[material]\nviscosity = 10\ndensity = 1200\nsurface_tension = 0.04\n"
                                            "[environment]\ngravity = [0, -9.81, 0]\n"
                                            "[inflow]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n",
                                            "s", settings));
}

TEST(Unlikely, NumbersInOtherUnits) {
  EXPECT_THAT(told({}), IsEmpty());
  EXPECT_THAT(told({"material.density=1.2"}), ElementsAre(HasSubstr("1.2 g/cm^3")));
  EXPECT_THAT(told({"material.density=1200 g/cm^3"}), ElementsAre(HasSubstr("1.2e+06 kg/m^3")));
  EXPECT_THAT(told({"material.density=20", "material.surface_tension=2.5"}), IsEmpty()); // foam, tungsten
  EXPECT_THAT(told({"environment.bath.density=1000"}), IsEmpty());
  EXPECT_THAT(told({"environment.bath.density=1.0"}), ElementsAre(HasSubstr("of the bath of 1 kg/m^3")));
  EXPECT_THAT(told({"environment.air.density=1.2"}), IsEmpty());
  EXPECT_THAT(told({"environment.air.density=1000"}), ElementsAre(HasSubstr("air of 1e+03 kg/m^3")));
  EXPECT_THAT(told({"material.surface_tension=40"}), ElementsAre(HasSubstr("surface tension of 40 N/m")));
  EXPECT_THAT(told({"environment.gravity=[0, -9810, 0]"}), ElementsAre(HasSubstr("1000 times that of the Earth")));
  EXPECT_THAT(told({"inflow.velocity=[100, 0, 0]"}), ElementsAre(HasSubstr("100 mm/s")));
  EXPECT_THAT(told({"sheet.velocity=[0, -100, 0]"}), ElementsAre(HasSubstr("starts with 100 m/s")));
}

TEST(Unlikely, EachLiquidOnce) {
  const std::string sheet = "[[sheet]]\nshape = \"disk\"\nradius = 0.1\nedge_length = 0.02\nthickness = 0.001\n",
                    own = "[sheet.material]\nviscosity = 10\ndensity = 1.3\n",
                    common = "[material]\nviscosity = 10\ndensity = 1.2\n";
  EXPECT_THAT(unlikely_values(scene::parse_scene(sheet + sheet + own + common, "s")),
              ElementsAre(HasSubstr("1.2 g/cm^3"), HasSubstr("1.3 g/cm^3")));
  EXPECT_THAT(unlikely_values(scene::parse_scene(sheet + sheet + common, "s")), ElementsAre(HasSubstr("1.2 g/cm^3")));
}

TEST(Unlikely, GlensExponentForItsInverse) {
  const auto with_index = [](const std::string& index) {
    return told({"material.law=power", "material.flow_index=" + index});
  };
  EXPECT_THAT(with_index("3"), ElementsAre(HasSubstr("flow_index is 1/n, here 0.3333")));
  EXPECT_THAT(with_index("0.3333"), IsEmpty());
  EXPECT_THAT(with_index("1.5"), IsEmpty());
}

// Only what is along the plane counts.
TEST(Unlikely, ABeltThatMovesOutOfItsPlane) {
  const auto told_of = [](const std::string& plane) {
    return unlikely_values(
        scene::parse_scene("[sheet]\nshape = \"disk\"\nradius = 0.1\nedge_length = 0.02\n"
                           "thickness = 0.001\n[material]\nviscosity = 10\ndensity = 1000\n[[solid]]\n"
                           "shape = \"plane\"\nsurface_velocity = [0, 0.1, 0]\n" +
                               plane,
                           "s"));
  };
  EXPECT_THAT(told_of("normal = [0, 1, 0]\n"), ElementsAre(HasSubstr("only 0 of 0.1 m/s")));
  EXPECT_THAT(told_of("normal = [1, 1, 0]\n"), ElementsAre(HasSubstr("only 0.0707 of 0.1 m/s")));
  EXPECT_THAT(told_of("normal = [1, 0.1, 0]\n"), IsEmpty());
}

} // namespace
} // namespace sheet
