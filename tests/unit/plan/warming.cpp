// SPDX-License-Identifier: GPL-3.0-or-later
// Proposed ends of runs: of sheets that are warmed until they flow, and of what changes by rows of times.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

double until(const std::string& text) {
  const Scene scene = scene::parse_scene(text, "s");
  return proposed_ring(scene, first_frame(scene), {}).until;
}

// Window glass, 4 mm thick, over two bars: 5e9 times as viscous at 500 degrees as at 750, which it has after 3 times
// rho c h/(2 (H + e sigma (T² + T_a²) (T + T_a))) = 37 s; then its weight stretches it by its length in mu/(rho g L) =
// 200 s.
std::string pane(const std::string& heat) {
  return "[sheet]\nshape = \"rectangle\"\nsize = [0.4, 0.2]\nedge_length = 0.04\nthickness = 0.004\ncenter = [0, "
         "0.012, "
         "0]\n[material]\ndensity = 2500\nviscosity_law = \"vft\"\nvft_a = -2.601\nvft_b = \"4330.9 "
         "K\"\nvft_temperature = \"246.1 degC\"\nreference_temperature = \"700 degC\"\n[environment]\ngravity = [0, "
         "-9.81, 0]\n[[hold]]\nregion = \"x_min\"\n[heat]\nspecific_heat = 1250\n" +
         heat;
}

TEST(Warming, EndsWhenWhatIsWarmHasFlowed) {
  const double warm =
      until(pane("temperature = \"750 degC\"\nambient = \"750 degC\"\ntransfer = 20\nemissivity = 0.9\n"));
  const double warmed =
      until(pane("temperature = \"500 degC\"\nambient = \"750 degC\"\ntransfer = 20\nemissivity = 0.9\n"));
  EXPECT_GT(warmed, warm);
  EXPECT_NEAR(warmed, warm + 3 * 36.6, 0.1 * warmed); // both are rounded
  const double later = until(pane("temperature = \"500 degC\"\nambient = [[0, \"500 degC\"], [3600, \"750 degC\"]]\n"
                                  "transfer = 20\nemissivity = 0.9\n"));
  EXPECT_NEAR(later, 3600 + warmed, 0.05 * later);
}

TEST(Warming, WhatCoolsGoesByItsStart) {
  const double start = until(pane("temperature = \"750 degC\"\nambient = \"750 degC\"\ntransfer = 20\n"));
  EXPECT_EQ(until(pane("temperature = \"750 degC\"\nambient = \"700 degC\"\ntransfer = 20\n")), start);
}

// From 750 degrees to where it has 1,000 times its viscosity, by exp(-t/time), time rho c h/(2 H) to 20 degrees. Its
// weight would go on for some 1000 s where nothing cools it.
TEST(Warming, EndsWhenWhatCoolsHasSet) {
  const std::string start = "temperature = \"750 degC\"\ntransfer = 80\nambient = ";
  const double set = 2500 * 1250 * 0.004 / (2 * 80);
  const double stiff = 4330.9 / (4330.9 / (750 - 246.1) + 3) + 246.1;
  const double falls = until(pane(start + "\"750 degC\"\n"));
  EXPECT_NEAR(until(pane(start + "\"20 degC\"\n")), set * std::log(730 / (stiff - 20)), 0.03 * set);
  EXPECT_GT(until(pane(start + "[[0, \"20 degC\"], [1, \"30 degC\"]]\n")), falls / 2); // by rows
  const std::string inflow = "[inflow]\nregion = \"x_max\"\nvelocity = [-0.001, 0, 0]\n";
  EXPECT_GT(until(pane(start + "\"20 degC\"\n" + inflow)), falls / 2);
}

TEST(Warming, WarmSolidsCount) {
  const std::string solid = "[[solid]]\nshape = \"box\"\nsize = [0.1, 0.01, 0.1]\ncenter = [0, -0.1, 0]\n";
  const std::string cold = "temperature = \"500 degC\"\n";
  EXPECT_GT(until(pane(cold + solid)), 1e9);
  EXPECT_LT(until(pane(cold + solid + "temperature = \"750 degC\"\ncontact_conductance = 500\n")), 2000);
}

TEST(Warming, GoesOnUntilTheLastRow) {
  const std::string sheet = "[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.01]\nplane = \"xy\"\nedge_length = "
                            "0.003\nthickness = 0.001\n[material]\nviscosity = 1\ndensity = 1000\n";
  const std::string inflow = "[inflow]\nregion = \"y_max\"\nvelocity = ";
  EXPECT_LT(until(sheet + inflow + "[0, -0.3, 0]\n"), 100);
  EXPECT_EQ(until(sheet + inflow + "[[0, 0, -0.3, 0], [100, 0, -0.1, 0]]\n"), 110);
  EXPECT_EQ(until(sheet + "[environment]\nair = {density = 1.2, wind = [[0, 1, 0, 0], [100, 2, 0, 0]]}\n"), 110);
}

} // namespace
} // namespace sheet
