// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/forecast.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "tests/unit/scene/scenes.h"

namespace sheet {
namespace {

TEST(Forecast, ALawTakesMoreTimeForTheSameSteps) {
  const auto foretold = [](const std::string& law) {
    const Scene scene = scene::parse_scene(
        scene::disk + "[material]\ndensity = 1000\n" + law + "[environment]\ngravity = [0, -9.81, 0]\n", "s");
    return forecast(scene, first_frame(scene), {.until = 1, .fps = 24, .stages = ""}, 0.01);
  };
  const Forecast newtonian = foretold("viscosity = 100\n");
  const Forecast hardly_thins =
      foretold("law = \"carreau\"\nzero_viscosity = 100\ntime_constant = 1e-9\nflow_index = 0.5\n");
  EXPECT_EQ(hardly_thins.steps, newtonian.steps);
  EXPECT_DOUBLE_EQ(hardly_thins.seconds, 3 * newtonian.seconds);
}

} // namespace
} // namespace sheet
