// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hole_forecast.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"

namespace sheet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A sheet of 1e-5 m³.
Scene scene_with(const std::string& more) {
  return scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.02\nthickness = 0.001\n"
                            "[material]\nviscosity = 1\ndensity = 1000\n" +
                                more,
                            "s");
}
const std::string drawn = "surface_tension = 0.05\n";
const std::string sites = "[tear]\nsites = 2e4\nat_thickness = 0.0006\nexponent = 6\n";

TEST(HoleForecast, SaysWhenTheFirstOpens) {
  const Scene scene = scene_with(drawn + sites);
  const auto scales = hole_scales(scene, build_frame(scene));
  ASSERT_EQ(scales.size(), 1U);
  EXPECT_NEAR(scales[0].value, 0.0006 * std::pow(0.2, 1.0 / 6) * std::tgamma(5.0 / 6), 1e-15);
  const Scene slow = scene_with(drawn + "[tear]\nsites = 2e4\nat_thickness = 0.0006\nexponent = 1\n");
  EXPECT_NEAR(hole_scales(slow, build_frame(slow))[0].value, 0.0006 * 0.2 / std::log(2), 1e-15);
  const Scene thin = scene_with(drawn + "[tear]\nbelow = 0.0001\n");
  EXPECT_THAT(hole_scales(thin, build_frame(thin)), IsEmpty());
}

TEST(HoleForecast, WarnsOfWhatDrawsNoHolesOpenAndOfASieve) {
  const auto warnings = [](const std::string& more) {
    const Scene scene = scene_with(more);
    return hole_warnings(scene, build_frame(scene));
  };
  EXPECT_THAT(warnings(drawn + sites), IsEmpty());
  EXPECT_THAT(warnings(sites), ElementsAre(HasSubstr("surface_tension")));
  EXPECT_THAT(warnings(drawn + "[tear]\nsites = 3e8\nat_thickness = 0.001\nexponent = 6\n"),
              ElementsAre(HasSubstr("some 3e+03 holes open at the start")));
  EXPECT_THAT(warnings(""), IsEmpty());
}

} // namespace
} // namespace sheet
