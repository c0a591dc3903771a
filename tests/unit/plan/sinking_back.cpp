// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/sinking_back.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// A film, 10 mm high at the start, drawn up at 50 mm/s out of an inlet that brings as much: 110 mm by 2 s.
std::string warning(const std::string& viscosity, const std::string& thickness, const std::string& rise = "0.05") {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.01]\nplane = \"xy\"\nedge_length = 0.004\nthickness = " +
          thickness + "\n[material]\nviscosity = " + viscosity +
          "\ndensity = 1250\nsurface_tension = 0.03\n[environment]\ngravity = [0, -10, 0]\n"
          "[[inflow]]\nregion = \"y_min\"\nvelocity = [0, 0.05, 0]\nuntil = 2\n[[hold]]\nregion = \"y_max\"\n"
          "motion = {kind = \"translating\", velocity = [0, " +
          rise + ", 0]}\n",
      "s");
  return sinking_back_warning(scene, first_frame(scene), 3);
}

// 2 gamma/(rho g h) = 24 mm of 0.2 mm; 110 mm of 0.0436 mm.
TEST(SinkingBack, WhereTensionDoesNotCarryIt) {
  EXPECT_THAT(warning("1.2", "2e-4"),
              testing::AllOf(testing::HasSubstr("higher than 0.024 m"), testing::HasSubstr("drawn up to 0.11 m"),
                             testing::HasSubstr("thickness = 4.36e-05")));
  EXPECT_EQ(warning("1.2", "4.3e-5"), "");
}

// (8 mu V/(rho g))^(1/2) = 0.25 m at V = 0.1 m/s and 1000 Pa s, of 310 mm; 0.36 m at 2000 Pa s.
TEST(SinkingBack, WhereViscosityDoesNotCarryIt) {
  EXPECT_THAT(warning("1000", "2e-4", "0.15"), testing::HasSubstr("higher than 0.253 m"));
  EXPECT_EQ(warning("2000", "2e-4", "0.15"), "");
}

} // namespace
} // namespace sheet
