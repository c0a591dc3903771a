// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/tiers.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

struct Ganache {
  static constexpr double viscosity = 15, density = 1200, g = 9.81, thickness = 0.004, speed = 0.3;
};

Scene poured_on(const std::string& sheet, const std::string& solids) {
  return scene::parse_scene(fmt::format("{}thickness = {}\n[material]\nviscosity = {}\ndensity = {}\n[environment]\n"
                                        "gravity = [0, {}, 0]\n{}[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n",
                                        sheet, Ganache::thickness, Ganache::viscosity, Ganache::density, -Ganache::g,
                                        solids),
                            "s");
}

// A curtain, 40 mm wide, that slides onto stairs.
Scene on_stairs(const std::string& solids) {
  return poured_on(
      "[inflow]\nregion = \"x_min\"\nvelocity = [0.3, 0, 0]\n[sheet]\nshape = \"rectangle\"\nsize = [0.03, "
      "0.04]\nedge_length = 0.01\ncenter = [-0.025, 0.102, 0]\n",
      solids);
}

std::string step(double from, double to, double top) {
  return fmt::format("[[solid]]\nshape = \"box\"\nsize = [{}, {}, 0.1]\ncenter = [{}, {}, 0]\ncontact = \"flow\"\n",
                     to - from, top, (from + to) / 2, top / 2);
}

// In which a level tier of that length is filled.
double filling(double length) {
  using G = Ganache;
  const double q = G::thickness * G::speed;
  return 0.8 * std::pow(12 * G::viscosity * q * length / (G::density * G::g), 0.25) * length / q;
}

TEST(Tiers, StairsAreFilledOneAfterTheOther) {
  const std::string high = step(-0.06, 0, 0.1), middle = step(0, 0.03, 0.06), low = step(0.03, 0.06, 0.02);
  const Scene one = on_stairs(high), two = on_stairs(high + middle), three = on_stairs(high + middle + low);
  EXPECT_EQ(time_over_tiers(one, first_frame(one), 0), 0); // a table is no tier
  const double upper = time_over_tiers(two, first_frame(two), 0), all = time_over_tiers(three, first_frame(three), 0);
  const double fall = std::sqrt(2 * 0.04 / Ganache::g);
  EXPECT_NEAR(upper, filling(0.04) + fall + filling(0.03 - Ganache::thickness), 0.1 * upper);
  EXPECT_NEAR(all - upper, fall + filling(0.03 - Ganache::thickness), 0.05 * all);
}

TEST(Tiers, OfWhatIsPouredStraightDownAllAround) {
  const std::string ring = "[inflow]\nregion = \"y_max\"\nvelocity = [0, -0.3, 0]\n[sheet]\nshape = \"tube\"\n"
                           "radius = 0.01\nheight = 0.03\nedge_length = 0.005\ncenter = [0, 0.15, 0]\n";
  const std::string cake = "[[solid]]\nshape = \"cylinder\"\nradius = 0.1\nheight = 0.05\ncenter = [0, 0.025, 0]\n"
                           "contact = \"flow\"\n[[solid]]\nshape = \"cylinder\"\nradius = 0.05\nheight = 0.05\n"
                           "center = [0, 0.075, 0]\ncontact = \"flow\"\n";
  const Scene scene = poured_on(ring, cake);
  const double time = time_over_tiers(scene, first_frame(scene), 0);
  EXPECT_GT(time, 3);
  EXPECT_LT(time, 15);
  EXPECT_GE(proposed_ring(scene, first_frame(scene), {}).until, time);
  EXPECT_EQ(time_over_tiers(poured_on(ring, ""), first_frame(scene), 0), 0); // on a plane
}

} // namespace
} // namespace sheet
