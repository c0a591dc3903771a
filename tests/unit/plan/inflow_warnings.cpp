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
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [0, 1, 0]\n"),
              testing::ElementsAre(testing::HasSubstr("inflow 0 goes up out of the sheet")));
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [1, 0.5, 0]\n"), testing::IsEmpty());
  EXPECT_THAT(warnings("xz", "region = \"x_min\"\nvelocity = [0, -1, 0]\n"), testing::IsEmpty()); // a curtain
  EXPECT_THAT(warnings("xy", "region = \"y_min\"\nvelocity = [0, 1, 0]\n"), testing::IsEmpty());  // a jet
}

// The inlet is 60 mm wide.
TEST(InflowWarnings, OfOneThatIsThickerThanWide) {
  const auto warnings_of = [](double thickness) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\nthickness = 0.003\n"
                    "[material]\nviscosity = 10\ndensity = 1200\n[inflow]\nregion = \"x_min\"\n"
                    "velocity = [1, 0, 0]\nthickness = {}\n",
                    thickness),
        "s");
    return inflow_warnings(scene, first_frame(scene));
  };
  EXPECT_THAT(warnings_of(3), testing::ElementsAre(testing::StartsWith(
                                  "inflow 0 is thicker (3 m) than wide (0.06 m): it is no sheet; if 3 mm are meant")));
  EXPECT_THAT(warnings_of(0.05), testing::IsEmpty());
}

} // namespace
} // namespace sheet
