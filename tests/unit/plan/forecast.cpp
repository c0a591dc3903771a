// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/forecast.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"
#include "libsheet/scene/sheet_edges.h"
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

// What flows in as a layer on a solid creeps along it: half an edge a step. From above the solid it falls, and folds.
TEST(Forecast, WhatFlowsInOnASolidTakesStepsOfHalfAnEdge) {
  const auto foretold = [](const std::string& height, const std::string& contact) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.04, 0.06]\nedge_length = 0.004\nthickness = 0.004\n"
        "center = [0, " +
            height +
            ", 0]\n[material]\ndensity = 1400\nviscosity = 5\n[environment]\n"
            "gravity = [0, -9.81, 0]\n[contact]\nself = true\n[inflow]\nregion = \"x_min\"\nvelocity = [0.05, 0, 0]\n"
            "[[solid]]\nshape = \"plane\"\ncontact = \"" +
            contact + "\"\n",
        "s");
    const formats::Frame first = first_frame(scene);
    const Forecast run = forecast(scene, first, {.until = 1, .fps = 24, .stages = ""}, 0.01);
    return (run.steps - 24) * scene::mean_edge(first);
  };
  EXPECT_NEAR(foretold("0.002", "flow"), 0.05 / 0.5, 1e-9);
  EXPECT_GT(foretold("0.1", "flow"), 1);
  EXPECT_GT(foretold("0.002", "stick"), 1);
}

// What lies on a slope and is held there creeps, as what is held by nothing does: its weight does not drive it as what
// falls.
TEST(Forecast, WhatLiesOnASlopeCreepsAlsoWhereItIsHeld) {
  const auto steps = [](const std::string& contact, const std::string& hold) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.2]\nplane = \"xy\"\ncenter = [0, 0, 0.001]\n"
        "edge_length = 0.008\nthickness = 0.002\n[material]\ndensity = 1000\nviscosity = 5\n[environment]\n"
        "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncontact = \"" +
            contact + "\"\n" + hold,
        "s");
    return forecast(scene, first_frame(scene), {.until = 55, .fps = 1, .stages = ""}, 0.01).steps;
  };
  const std::string hold = "[[hold]]\nregion = \"y_max\"\n";
  EXPECT_LT(steps("flow", ""), 200);
  EXPECT_LT(steps("flow", hold), 200);
  EXPECT_GT(steps("stick", hold), 1000);
}

// A layer on a disk that turns by 4 rad/s, speeding up for a second, and slows down again after ten: 40 rad in all, in
// steps of the third root of an edge over the layer's size.
TEST(Forecast, WhatFlowsOnADiskThatTurnsTakesStepsOfItsTurning) {
  const auto steps = [](const std::string& contact) {
    const Scene scene = scene::parse_scene(
        scene::disk + scene::liquid +
            "[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = \"cylinder\"\nradius = 3\nheight = 1\ncenter "
            "= [0, -0.5, 0]\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = [[0, 0], [1, 4], [10, 4], [11, "
            "0]]}\n" +
            contact,
        "s");
    const formats::Frame first = first_frame(scene);
    const double part = std::cbrt(scene::mean_edge(first) / *measured(first).length);
    return (forecast(scene, first, {.until = 20, .fps = 0.05, .stages = ""}, 0.01).steps - 1) * part;
  };
  EXPECT_NEAR(steps("contact = \"flow\"\n"), 40, 0.1);
  EXPECT_LT(steps("contact = \"stick\"\n"), 39);
}

} // namespace
} // namespace sheet
