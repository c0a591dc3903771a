// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/passing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of a layer of 160 by 100 mm, 10 mm thick, on a table, and a ball of 8 mm radius.
double passing(const std::string& ball, double gravity = 0, double height = 0) {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.16, 0.1]\nedge_length = 0.01\nthickness = 0.01\n"
                  "center = [0, {}, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
                  "gravity = [0, {}, 0]\n[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n"
                  "[[solid]]\nshape = \"sphere\"\nradius = 0.008\n{}",
                  height + 0.005, -gravity, ball),
      "s");
  return passing_time(scene, first_frame(scene));
}

TEST(Passing, UntilABallHasLeftTheSheet) {
  EXPECT_NEAR(passing("center = [-0.11, 0.012, 0]\nvelocity = [0.06, 0, 0]\n"), (0.11 + 0.088 + 0.005) / 0.06, 1e-9);
  EXPECT_EQ(passing("center = [-0.11, 0.02, 0]\nvelocity = [0.06, 0, 0]\n"), 0); // above it
  EXPECT_EQ(passing("center = [-0.11, 0.012, 0]\nvelocity = [-0.06, 0, 0]\n"), 0);
  EXPECT_EQ(passing("center = [0, 0.012, 0]\n"), 0);
  EXPECT_EQ(passing("center = [-0.11, 0.012, 0]\nvelocity = [0.06, 0, 0]\nangular_velocity = [0, 0, -1]\n"),
            passing("center = [-0.11, 0.012, 0]\nvelocity = [0.06, 0, 0]\n"));
}

// Lifted out, it goes as far as the sheet is wide, from when it has its speed.
TEST(Passing, UntilABallThatIsLiftedHasGoneFar) {
  const double width = 0.11; // with what it is thick
  EXPECT_NEAR(passing("center = [0, 0.008, 0]\n"
                      "motion = {kind = \"translating\", velocity = [[0.4, 0, 0, 0], [0.5, 0, 0.06, 0]]}\n"),
              0.5 + width / 0.06, 1e-9);
}

TEST(Passing, OfASheetThatFallsPastIt) {
  const std::string ball = "center = [-0.2, 0.05, 0]\nvelocity = [0.1, 0, 0]\n";
  EXPECT_EQ(passing(ball, 0, 0.2), 0);
  EXPECT_GT(passing(ball, 9.81, 0.2), 0.28 / 0.1);
}

// A curtain of 80 by 20 mm, 2 mm thick, above nothing but what is carried through it later.
TEST(Passing, OfABallThatComesToACurtainFarBelowItsInlet) {
  const auto passing = [](const std::string& inflow, double height) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.02]\nplane = \"xy\"\nedge_length = 0.01\n"
                    "thickness = 0.002\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
                    "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"sphere\"\nradius = 0.02\n"
                    "center = [0, {}, -0.1]\nvelocity = [0, 0, 0.1]\n{}",
                    height, inflow),
        "s");
    const auto first = first_frame(scene);
    const double time = passing_time(scene, first);
    EXPECT_GE(proposed_ring(scene, first, {}).until, time);
    return time;
  };
  const std::string inflow = "[inflow]\nregion = \"y_max\"\nvelocity = [0, -0.2, 0]\nthickness = 0.002\n";
  EXPECT_NEAR(passing(inflow, -0.1), (0.12 + 0.001) / 0.1, 1e-9);
  EXPECT_NEAR(passing(inflow, -0.2), (0.12 + 0.001) / 0.1, 1e-9);
  EXPECT_EQ(passing(inflow, 0.1), 0); // above it
  EXPECT_EQ(passing("", -0.1), 0);    // it has fallen past before
}

// Of what comes to the sheet in it: not of what turns above it, nor once it stands.
TEST(Passing, OneTurn) {
  const auto turning = [](double height, std::string_view rate) {
    return passing(
        fmt::format("center = [0, {}, 0.04]\nmotion = {{kind = \"rotating\", axis = [1, 0, 0], center = [0, {}, 0], "
                    "rate = {}}}\n",
                    height, height, rate));
  };
  EXPECT_NEAR(turning(0.05, "2"), std::numbers::pi, 1e-9);
  EXPECT_EQ(turning(0.1, "2"), 0);
  EXPECT_EQ(turning(0.05, "[[0, 2], [1, 0]]"), 0);
  constexpr std::string_view inflow = "2}\n[[inflow]]\nregion = \"x_min\"\nvelocity = [1, 0, 0]\nthickness = 0.01\n#";
  EXPECT_NEAR(turning(0.1, inflow), std::numbers::pi, 1e-9); // what flows in may come to it
}

// Of a film of 10 by 20 mm whose side x_max is drawn away from x_min.
TEST(Passing, UntilHoldsHaveDrawnTheSheetToTwiceItsLength) {
  const auto drawing = [](const std::string& hold, const std::string& other) {
    const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.01, 0.02]\nedge_length = 0.002\n"
                                           "plane = \"xy\"\nthickness = 1e-4\n[material]\nviscosity = 10\n"
                                           "density = 1000\nsurface_tension = 0.05\n[[hold]]\nregion = \"x_max\"\n" +
                                               hold + "[[hold]]\nregion = \"x_min\"\n" + other,
                                           "s");
    const auto first = first_frame(scene);
    const double time = drawing_time(scene, first);
    EXPECT_GE(proposed_ring(scene, first, {}).until, time);
    return time;
  };
  const std::string away = "motion = {kind = \"translating\", velocity = [0.005, 0, 0]}\n";
  const double thickness = 1e-4; // the box has it
  EXPECT_NEAR(drawing(away, ""), (0.01 + thickness) / 0.005, 1e-9);
  EXPECT_NEAR(drawing(away, "motion = {kind = \"translating\", velocity = [-0.005, 0, 0]}\n"),
              (0.01 + thickness) / 0.01, 1e-9);
  EXPECT_NEAR(drawing("motion = {kind = \"translating\", velocity = [[0, 0, 0, 0], [1, 0.005, 0, 0]]}\n", ""),
              1 + (0.01 + thickness) / 0.005, 1e-9);
  EXPECT_EQ(drawing("motion = {kind = \"translating\", velocity = [-0.005, 0, 0]}\n", ""), 0); // pressed together
  EXPECT_EQ(drawing(away, away), 0);
  EXPECT_EQ(drawing(away, "until = 0.01\n"), 0);
  EXPECT_EQ(drawing("", ""), 0);
}

// Of a film between two rings, the upper one of which may turn.
TEST(Passing, UntilAHoldHasTurnedOnce) {
  const auto turning = [](const std::string& rate, const std::string& more) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"tube\"\nradius = 0.03\nheight = 0.02\nedge_length = 0.005\nthickness = 2e-4\n[material]\n"
        "viscosity = 10\ndensity = 1000\n[[hold]]\nregion = \"y_min\"\n[[hold]]\nregion = \"y_max\"\n"
        "motion = {kind = \"rotating\", axis = [0, 1, 0], rate = " +
            rate + "}\n" + more,
        "s");
    const auto first = first_frame(scene);
    const double time = turning_time(scene, first);
    EXPECT_GE(proposed_ring(scene, first, {}).until, std::min(time, 5.0));
    return time;
  };
  EXPECT_NEAR(turning("-2", ""), std::numbers::pi, 1e-9);
  EXPECT_NEAR(turning("[[0, 0], [1, 2]]", ""), 1 + std::numbers::pi, 1e-9);
  EXPECT_EQ(turning("[[0, 2], [1, 0]]", ""), 0);
  EXPECT_EQ(turning("2", "until = 1\n"), 0);
}

// Of a strip 80 mm long, 4 mm thick, that lies on a belt, or falls on it.
double carrying(const std::string& more, double height = 0, const std::string& belt = "[0.1, 0, 0]") {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.03]\nedge_length = 0.01\nthickness = 0.004\n"
                  "center = [0, {}, 0]\n[material]\nviscosity = 50\ndensity = 1400\n[environment]\n"
                  "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\nsurface_velocity = {}\n{}",
                  height + 0.002, belt, more),
      "s");
  return carrying_time(scene, first_frame(scene));
}

// A blade 4 mm wide, 0.3 m away.
TEST(Passing, UntilABeltHasCarriedTheSheetPastABlade) {
  const std::string blade = "[[solid]]\nshape = \"box\"\nsize = [0.004, 0.03, 0.1]\ncenter = [0.3, 0.018, 0]\n";
  constexpr double way = 0.302 + 0.04 + 0.002; // with half of what the strip is thick
  EXPECT_NEAR(carrying(blade), way / 0.1, 1e-9);
  EXPECT_NEAR(carrying(blade, 0.05), way / 0.1, 1e-9);
  EXPECT_EQ(carrying(blade, 0, "[-0.1, 0, 0]"), 0);
  EXPECT_EQ(carrying(blade, 0, "[0, 0, 0.1]"), 0);
  EXPECT_EQ(carrying(blade + "velocity = [0, 0.1, 0]\n"), 0);                       // it is not there any more
  EXPECT_NEAR(carrying(blade + "angular_velocity = [0, 5, 0]\n"), way / 0.1, 1e-9); // turning on the spot
  EXPECT_EQ(carrying(""), 0);
}

// Two strips that come 2 s one after the other.
TEST(Passing, UntilABeltHasCarriedPastARollerWhatEntersLater) {
  const std::string strip = "[[sheet]]\nshape = \"rectangle\"\nsize = [0.08, 0.03]\nedge_length = 0.01\n"
                            "thickness = 0.004\ncenter = [0, 0.002, 0]\n";
  const Scene scene = scene::parse_scene(
      strip + strip + "enters = 2\n[material]\nviscosity = 50\ndensity = 1400\n[environment]\n" +
          "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\nsurface_velocity = [0.1, 0, 0]\n" +
          "[[solid]]\nshape = \"sphere\"\nradius = 0.02\ncenter = [0.3, 0.03, 0]\nangular_velocity = [0, 0, -5]\n",
      "s");
  EXPECT_GE(proposed_ring(scene, first_frame(scene), {}).until, 2 + (0.3 + 0.02 + 0.04) / 0.1);
}

// And past the blade to an outflow, 0.5 m away.
TEST(Passing, UntilABeltHasCarriedTheSheetToAnOutflow) {
  const std::string end = "[[outflow]]\npoint = [0.5, 0, 0]\nnormal = [1, 0, 0]\n",
                    behind = "[[outflow]]\npoint = [-0.5, 0, 0]\nnormal = [-1, 0, 0]\n",
                    below = "[[outflow]]\npoint = [0, -0.5, 0]\nnormal = [0, -1, 0]\n";
  constexpr double way = 0.5 + 0.04 + 0.002;
  EXPECT_NEAR(carrying(end), way / 0.1, 1e-9);
  EXPECT_NEAR(carrying(end + "[[solid]]\nshape = \"box\"\nsize = [0.004, 0.03, 0.1]\ncenter = [0.3, 0.018, 0]\n"),
              way / 0.1, 1e-9);
  EXPECT_NEAR(carrying(behind + end + below, 0.05), way / 0.1, 1e-9);
  EXPECT_EQ(carrying(behind), 0);
  EXPECT_EQ(carrying(below), 0);
}

// Two belts of 150 mm, of which the second one runs 15 mm lower, on a table under both.
TEST(Passing, UntilABeltHasCarriedTheSheetPastASecondOne) {
  const auto belt = [](double x, double y) {
    return fmt::format("[[solid]]\nshape = \"box\"\nsize = [0.15, 0.01, 0.06]\ncenter = [{}, {}, 0]\n"
                       "surface_velocity = [0.1, 0, 0]\n",
                       x, y);
  };
  const std::string sheet =
                        "[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.03]\nedge_length = 0.01\nthickness = 0.004\n"
                        "center = [-0.06, 0.032, 0]\n[material]\nviscosity = 50\ndensity = 1400\n[environment]\n"
                        "gravity = [0, -9.81, 0]\n",
                    table = "[[solid]]\nshape = \"box\"\nsize = [2, 0.02, 1]\ncenter = [0, -0.02, 0]\n";
  const Scene scene = scene::parse_scene(sheet + belt(-0.075, 0.025) + belt(0.08, 0.01) + table, "s");
  EXPECT_NEAR(carrying_time(scene, first_frame(scene)), (0.155 + 0.1 + 0.002) / 0.1, 1e-9);
}

// The same board 0.3 m above a bath, and 0.3 m before an outflow.
TEST(Passing, UntilWhatFlowsDownASlopeHasComeToABathOrAnOutflow) {
  const auto running = [](const std::string& bath, const std::string& more) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.04]\nedge_length = 0.005\nthickness = 0.005\n"
        "center = [0.01, 0.0025, 0]\n[material]\nviscosity = 14\ndensity = 1400\n[environment]\n"
        "gravity = [5, -8.66, 0]\n" +
            bath +
            "[[inflow]]\nregion = \"x_min\"\nvelocity = [0.01, 0, 0]\n[[solid]]\nshape = \"plane\"\n"
            "normal = [0, 1, 0]\ncontact = \"flow\"\n" +
            more,
        "s");
    return running_time(scene, first_frame(scene));
  };
  const double flux = 0.005 * 0.01, speed = flux / std::cbrt(3 * 0.01 * flux / 5);
  EXPECT_NEAR(running("bath = {density = 1000, level = -0.3}\n", ""), 0.6 / speed, 0.06 * 0.6 / speed);
  EXPECT_NEAR(running("", "[[outflow]]\npoint = [0.3, 0, 0]\nnormal = [1, 0, 0]\n"), 0.3 / speed, 0.06 * 0.3 / speed);
  EXPECT_EQ(running("", "[[outflow]]\npoint = [-0.3, 0, 0]\nnormal = [-1, 0, 0]\n"), 0);
}

// Of honey, 5 mm thick, that flows in on a board that leans by 30 degrees, 0.2 m before a wall of 10 mm.
TEST(Passing, UntilWhatFlowsDownASlopeHasComePastAWall) {
  const auto running = [](const std::string& inflow, const std::string& contact, double gravity_along) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.04]\nedge_length = 0.005\nthickness = 0.005\n"
                    "center = [0.01, 0.0025, 0]\n[material]\nviscosity = 14\ndensity = 1400\n[environment]\n"
                    "gravity = [{}, -8.5, 0]\n[[inflow]]\nregion = \"x_min\"\nvelocity = [0.01, 0, 0]\n{}"
                    "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"{}\"\n[[solid]]\n"
                    "shape = \"box\"\nsize = [0.01, 0.1, 0.02]\ncenter = [0.225, 0.05, 0]\n",
                    gravity_along, inflow, contact),
        "s");
    const auto first = first_frame(scene);
    const double time = running_time(scene, first);
    EXPECT_GE(proposed_ring(scene, first, {}).until, std::min(time, 60.0)); // what takes very long is not waited for
    return time;
  };
  const double flux = 0.005 * 0.01, way = 0.21 + 0.02 + 0.0025, nu = 0.01; // from the box that has the thickness
  const double nusselt = std::cbrt(3 * nu * flux / 4.9);
  EXPECT_NEAR(running("", "flow", 4.9), way / (flux / nusselt), 0.01 * way / (flux / nusselt));
  const double late = 4 * nu * std::pow(way, 3) / (9 * std::pow(2 * flux, 2) * 4.9);
  EXPECT_NEAR(running("until = 2\n", "flow", 4.9), late, 0.05 * late);
  EXPECT_EQ(running("", "stick", 4.9), 0);
  EXPECT_EQ(running("", "flow", 0.1), 0);
  EXPECT_EQ(running("", "flow", -4.9), 0);
}

// The same honey on a board that ends 0.28 m before what flows in.
TEST(Passing, UntilWhatFlowsDownASlopeHasComeToItsEnd) {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.04]\nedge_length = 0.005\nthickness = 0.005\n"
      "center = [0.01, 0.0025, 0]\n[material]\nviscosity = 14\ndensity = 1400\n[environment]\n"
      "gravity = [4.9, -8.5, 0]\n[[inflow]]\nregion = \"x_min\"\nvelocity = [0.01, 0, 0]\n"
      "[[solid]]\nshape = \"box\"\nsize = [0.6, 0.1, 0.3]\ncenter = [0, -0.05, 0]\ncontact = \"flow\"\n",
      "s");
  const double flux = 0.005 * 0.01, speed = flux / std::cbrt(3 * 0.01 * flux / 4.9), way = 0.28 - 0.0025;
  EXPECT_NEAR(running_time(scene, first_frame(scene)), way / speed, 0.01 * way / speed);
}

// Of syrup, 40 by 40 mm and 5 mm thick, that lies on the same board, 0.3 m before an outflow: from Huppert's law for
// the whole block, from its upper end, less what it is long at the start; into a bath, past a wall; what stands,
// sticks, is held up by a belt or cools is not waited for.
TEST(Passing, UntilWhatLiesOnASlopeHasComeToTheEndOfIt) {
  const auto sliding = [](const std::string& law, const std::string& contact, const std::string& bath,
                          const std::string& more) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.04, 0.04]\nedge_length = 0.005\nthickness = 0.005\n"
        "center = [0.02, 0.0025, 0]\n[material]\ndensity = 1400\n" +
            law + "[environment]\ngravity = [5, -8.66, 0]\n" + bath +
            "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"" + contact + "\"\n" + more,
        "s");
    return running_time(scene, first_frame(scene));
  };
  const std::string syrup = "viscosity = 14\n", outflow = "[[outflow]]\npoint = [0.34, 0, 0]\nnormal = [1, 0, 0]\n";
  const auto by_law = [](double way) { // whole beyond it
    const double area = 0.005 * 0.04;
    return 4 * 0.01 * (std::pow(0.04 + way, 3) - std::pow(0.04, 3)) / (9 * area * area * 5) + std::sqrt(2 * way / 5);
  };
  EXPECT_NEAR(sliding(syrup, "flow", "", outflow), by_law(0.3425), 0.02 * by_law(0.3425));
  EXPECT_NEAR(sliding(syrup, "flow", "bath = {density = 1000, level = -0.3}\n", ""), by_law(0.611),
              0.02 * by_law(0.611));
  const std::string wall = "[[solid]]\nshape = \"box\"\nsize = [0.01, 0.1, 0.02]\ncenter = [0.225, 0.05, 0]\n";
  EXPECT_NEAR(sliding(syrup, "flow", "", wall), by_law(0.2325), 0.02 * by_law(0.2325));
  EXPECT_EQ(sliding(syrup, "stick", "", outflow), 0);
  EXPECT_EQ(sliding(syrup, "flow", "", ""), 0);
  EXPECT_EQ(sliding(syrup, "flow", "", outflow + "[heat]\nspecific_heat = 2000\ntemperature = 300\nambient = 300\n"),
            0);
  const std::string mud = "law = \"bingham\"\nviscosity = 14\nyield_stress = ";
  EXPECT_GT(sliding(mud + "1\n", "flow", "", outflow), by_law(0.3425));
  EXPECT_EQ(sliding(mud + "20\n", "flow", "", outflow), 0); // stands where it is 2.9 mm thick: 75 mm farther down
}

} // namespace
} // namespace sheet
