// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

const std::string newtonian = "viscosity = 1e5\n", from_above = "[[hold]]\nregion = \"y_max\"\n",
                  weight = "[environment]\ngravity = [0, -10, 0]\n";

// A strip of 0.2 by 0.3 m, upright; rho g D = 3000 Pa.
Scene strip(const std::string& law, const std::string& tables) {
  return scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.02\n"
                            "thickness = 0.005\n[material]\ndensity = 1000\n" +
                                law + tables,
                            "s");
}

std::optional<double> runaway(const std::string& law, const std::string& tables) {
  const Scene scene = strip(law, tables);
  return runaway_time(scene, first_frame(scene));
}

TEST(Hanging, RunsAwayByTroutonsViscosity) {
  EXPECT_NEAR(*runaway(newtonian, weight + from_above), 3 * 1e5 / 3000.0, 1e-3 * 100);
  // Held at both ends, each bears half.
  EXPECT_NEAR(*runaway(newtonian, weight + from_above + "[[hold]]\nregion = \"y_min\"\n"), 200, 0.1 * 200);
}

// The integral of 1/rate is n (K/tau)^(1/n) of a power law.
TEST(Hanging, OfAPowerLawByTheClosedForm) {
  const double closed = 0.5 * std::pow(400.0 / (3000.0 / 3), 2);
  EXPECT_NEAR(*runaway("law = \"power\"\nviscosity = 400\nflow_index = 0.5\n", weight + from_above), closed,
              5e-3 * closed);
}

TEST(Hanging, NotOfWhatStandsOrIsCaught) {
  EXPECT_FALSE(runaway("law = \"bingham\"\nviscosity = 400\nyield_stress = 2000\n", weight + from_above));
  EXPECT_FALSE(runaway(newtonian + "surface_tension = 10\n", weight + from_above));
  EXPECT_FALSE(runaway(newtonian, from_above));
  EXPECT_FALSE(runaway(newtonian, weight));
  EXPECT_FALSE(runaway(newtonian, weight + from_above + "until = 9\n"));
  EXPECT_FALSE(runaway(newtonian, weight + from_above + "[[solid]]\nshape = \"plane\"\ncenter = [0, -1, 0]\n"));
}

// A hollow gob of glass on a pipe that turns, with some gas in it: D = 78 mm, 3 mu/(rho g D) = 0.45 s.
TEST(Hanging, AGobOnItsPipe) {
  const auto gob = [](const std::string& axis, double gas, double transfer = 10) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"cap\"\nradius = 0.04\nangle = \"160 deg\"\nedge_length = 0.007\n"
                    "thickness = 0.005\nrotation = {{axis = [1, 0, 0], angle = \"180 deg\"}}\n[material]\n"
                    "viscosity = 800\ndensity = 2500\nviscosity_law = \"exponential\"\n"
                    "reference_temperature = \"1000 degC\"\ntemperature_coefficient = 0.02\n[environment]\n"
                    "gravity = [0, -9.81, 0]\npressure = {{law = \"gas\", value = {}}}\n[[hold]]\nregion = \"rim\"\n"
                    "motion = {{kind = \"rotating\", axis = {}, rate = 3}}\n[heat]\nspecific_heat = 1200\n"
                    "temperature = \"1050 degC\"\nambient = \"30 degC\"\ntransfer = {}\n",
                    gas, axis, transfer),
        "s");
    return runaway_time(scene, first_frame(scene));
  };
  EXPECT_NEAR(gob("[0, 1, 0]", 150).value_or(0), 3 * 800 / std::exp(1.0) / (2500 * 9.81 * 0.079), 0.02);
  EXPECT_FALSE(gob("[1, 0, 0]", 150));
  EXPECT_FALSE(gob("[0, 1, 0]", 900));      // is blown up
  EXPECT_FALSE(gob("[0, 1, 0]", 150, 1e5)); // sets before
}

// Creeping, it is drawn out, and then falls within some times of free fall, sqrt(L/g), which is all there is to see.
TEST(Hanging, TheRunEndsWhenItHasRunAway) {
  const auto until = [](const std::string& law) {
    const Scene scene = strip(law, weight + from_above);
    return proposed_ring(scene, first_frame(scene), {}).until;
  };
  EXPECT_EQ(until(newtonian), 90);
  EXPECT_NEAR(until("viscosity = 10\n"), 5 * std::sqrt(0.2 / 10), 0.05); // falls at once
}

} // namespace
} // namespace sheet
