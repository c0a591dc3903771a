// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/hanging.h"

#include <cmath>
#include <string>

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
