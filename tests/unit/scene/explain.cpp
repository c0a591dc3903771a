// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/explain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes.h"

namespace sheet::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const DimensionlessNumber* number(const Explanation& e, std::string_view name) {
  for (const auto& n : e.numbers)
    if (n.name == name)
      return &n;
  return nullptr;
}
double scale(const Explanation& e, std::string_view symbol) {
  for (const auto& s : e.scales)
    if (s.symbol == symbol)
      return s.value;
  return 0;
}
Explanation of(const std::string& text) { return explain(parse_scene(text, "s")); }

TEST(Explain, WarnsOfAnglesThatWereMeantInDegrees) {
  const std::string turned = disk + "rotation = {axis = [1, 0, 0], angle = ",
                    box = disk + liquid +
                          "[[solid]]\nshape = \"box\"\nsize = [1, 1, 1]\nrotation = {axis = [0, 0, 1], angle = ";
  EXPECT_THAT(
      of(turned + "30}\n" + liquid).warnings,
      testing::Contains("the sheet is turned by 30 rad, 4.77 times round: a plain number is in radians; degrees "
                        "are written \"30 deg\""));
  EXPECT_THAT(of(box + "-45}\n").warnings,
              testing::Contains(testing::StartsWith("solid 0 is turned by -45 rad, 7.16 times round")));
  for (const std::string angle : {"\"-30 deg\"", "\"360 deg\"", "1.5"}) {
    EXPECT_THAT(of(turned + angle + "}\n" + liquid).warnings,
                testing::Not(testing::Contains(testing::HasSubstr("radians"))));
    EXPECT_THAT(of(box + angle + "}\n").warnings, testing::Not(testing::Contains(testing::HasSubstr("radians"))));
  }
}

TEST(Explain, WarnsOfJumpsAndOfSheetsInMillimetres) {
  const auto warned = [](const Explanation& e, std::string_view words) {
    return std::ranges::any_of(e.warnings, [&](const std::string& w) { return w.find(words) != std::string::npos; });
  };
  const auto led = [](const std::string& interpolation) {
    return disk + liquid +
           "[[solid]]\nshape = \"sphere\"\nradius = 0.1\nmotion = {kind = \"keyframed\", times = [0, 1], " +
           "places = [[0, 0, 0], [1, 0, 0]], interpolation = \"" + interpolation + "\"}\n";
  };
  EXPECT_TRUE(warned(of(led("step")), "solid 0 jumps at its rows"));
  EXPECT_FALSE(warned(of(led("smooth")), "jumps"));
  EXPECT_FALSE(warned(of(led("linear")), "jumps"));
  const std::string two = led("smooth") + led("smooth").substr((disk + liquid).size());
  EXPECT_EQ(std::ranges::count_if(of(two).warnings, [](const std::string& w) { return w.find("sets off") != w.npos; }),
            1);
  EXPECT_TRUE(warned(of(two), "solid 0 (and 1 more alike) sets off at 1 m/s at 0 s and stops from"));
  EXPECT_TRUE(warned(of(led("smooth")), "solid 0 sets off at 1 m/s at 0 s and stops from 1 m/s at 1 s, at once"));
  EXPECT_FALSE(warned(of(led("linear")), "sets off"));
  const auto along = [](const std::string& rows) {
    return disk + liquid + "[[solid]]\nshape = \"sphere\"\nradius = 0.1\nmotion = {kind = \"keyframed\", " + rows +
           "}\n";
  };
  // 0.28 m/s at the start of a parabola with its top at 0.5 s, and the remedy that is told
  EXPECT_TRUE(warned(of(along("times = [0, 0.5, 1], places = [[0, 0, 0], [0.07, 0, 0], [0, 0, 0]]")),
                     "solid 0 sets off at 0.28 m/s at 0 s and stops from 0.28 m/s at 1 s"));
  EXPECT_FALSE(warned(of(along("times = [-0.1, 0, 0.5, 1, 1.1], places = [[0, 0, 0], [0, 0, 0], [0.07, 0, 0], "
                               "[0, 0, 0], [0, 0, 0]]")),
                      "at once"));
  const std::string q0 = "[1, 0, 0, 0]", q1 = "[0.8, 0.6, 0, 0]";
  EXPECT_TRUE(warned(of(along("times = [-1, 2], rotations = [" + q0 + ", " + q1 + "]")),
                     "solid 0 stops from 0.429 rad/s at 2 s, at once"));
  EXPECT_FALSE(warned(of(along("times = [0, 1, 3, 4], rotations = [" + q0 + ", " + q0 + ", " + q1 + ", " + q1 + "]")),
                      "at once"));
  const auto sized = [](const std::string& radius) {
    return "[sheet]\nshape = \"disk\"\nedge_length = 1\nthickness = 0.1\nradius = " + radius + "\n" + liquid;
  };
  EXPECT_TRUE(warned(of(sized("50")),
                     "the sheet is 50 m long: write \"50 mm\" if you mean that; numbers without unit are "
                     "metres"));
  EXPECT_FALSE(warned(of(sized("5")), "numbers without unit are metres"));
  EXPECT_FALSE(warned(of("[sheet]\nshape = \"disk\"\nedge_length = \"20 km\"\nthickness = \"8 km\"\nradius = \"600 "
                         "km\"\n[material]\nviscosity = 1e21\ndensity = 3300\n"),
                      "numbers without unit are metres"));
  const Scene mesh = parse_scene("[sheet]\nshape = \"mesh\"\nfile = \"a.obj\"\nthickness = 0.1\n" + liquid, "s");
  EXPECT_TRUE(
      warned(explain(mesh, std::array{Measured{.length = 50, .thickness = 0.1, .curvature = {}}}), "scale = 0.001"));
  EXPECT_FALSE(
      warned(explain(mesh, std::array{Measured{.length = 5, .thickness = 0.1, .curvature = {}}}), "scale = 0.001"));
}

TEST(Explain, PlanesAreLevelUnderTiltedGravity) {
  const auto warnings = [](const std::string& gravity, const std::string& plane, const std::string& more = "") {
    return of(disk + more + liquid + "[environment]\ngravity = " + gravity + "\n[[solid]]\nshape = \"plane\"\n" + plane)
        .warnings;
  };
  const auto told = testing::Contains(
      "solid 0 (plane): its normal is against gravity, as by default, so it is level, though gravity is along no axis: "
      "for a slope normal = [0, 1, 0]");
  EXPECT_THAT(warnings("[3.36, -9.22, 0]", "center = [0, -1, 0]\n"), told);
  EXPECT_THAT(warnings("[3.36, -9.22, 0]", "center = [0, -1, 0]\nnormal = [0, 1, 0]\n"), testing::Not(told));
  EXPECT_THAT(warnings("[0, -9.81, 0]", "center = [0, -1, 0]\n"), testing::Not(told));
  EXPECT_THAT(
      warnings("[3.36, -9.22, 0]", "center = [0, -1, 0]\n", "rotation = {axis = [0, 0, 1], angle = \"20 deg\"}\n"),
      testing::Not(told));
}

TEST(Explain, ABathHasNoTensionOfItsOwn) {
  const auto left_out = [](const std::string& more) {
    return of(disk + liquid + more + "[environment]\ngravity = [0, -9.81, 0]\nbath = {density = 1000, level = 0}\n")
        .left_out;
  };
  EXPECT_THAT(left_out(""), testing::Contains("the bath has no waves and no viscosity"));
  EXPECT_THAT(
      left_out("surface_tension = 0.03\n"),
      testing::Contains("the bath has no waves, no surface tension of its own, which would pull on rims, and no "
                        "viscosity"));
}

TEST(Explain, ContactAnglesNeedTension) {
  const auto warnings = [](const std::string& more) {
    return of(disk + liquid + more + "[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\ncontact_angle = 1\n").warnings;
  };
  const std::string word = "contact_angle of solid 0 does nothing: there is no surface_tension in [material]";
  EXPECT_THAT(warnings(""), testing::Contains(word));
  EXPECT_THAT(warnings("surface_tension = 0.03\n"), testing::Not(testing::Contains(word)));
  EXPECT_THAT(warnings("[[solid]]\nshape = \"sphere\"\nradius = 1\ncontact = \"flow\"\ncontact_angle = 1\n"),
              testing::Contains(testing::StartsWith("contact_angle of solid 0 (and 1 more alike) does nothing")));
}

TEST(Explain, WarnsOfEverySheetByItsName) {
  const auto sheet = [](std::string_view name, std::string_view edge, std::string_view thickness) {
    return fmt::format("[[sheet]]\n{}shape = \"disk\"\nradius = 1\nedge_length = {}\nthickness = {}\n", name, edge,
                       thickness);
  };
  const Explanation e =
      of(sheet("", "0.1", "0.02") + sheet("name = \"upper\"\n", "0.01", "0.02") + sheet("", "0.1", "0.5") + liquid +
         "[environment]\ngravity = [0, 0, -9.81]\n" + "[[hold]]\nregion = \"rim\"\nsheet = \"upper\"\n");
  EXPECT_EQ(e.judged, "sheet 0");
  EXPECT_THAT(to_text(e), testing::HasSubstr("\nScales of sheet 0\n"));
  const std::string falls = "nothing holds or catches the sheet: it falls for ever";
  EXPECT_THAT(e.warnings, ElementsAre("sheet 0: " + falls,
                                      "sheet \"upper\": edge_length 0.01 m is below the thickness 0.02 m: a sheet has "
                                      "no detail that fine",
                                      "sheet 2: edge_length 0.1 m is below the thickness 0.5 m: a sheet has no detail "
                                      "that fine",
                                      "sheet 2: the sheet is thicker than a fifth of its length: the equations of thin "
                                      "sheets are doubtful",
                                      "sheet 2: " + falls));
}

TEST(Explain, SaysWhereAirWouldBeFelt) {
  // rho = 1000, h = 0.02
  const auto left_out = [](const std::string& speed, const std::string& air) {
    return of(disk + "velocity = [0, 0, -" + speed + "]\n" + liquid + "[environment]\ngravity = [0, 0, -10]\n" + air)
        .left_out.back();
  };
  EXPECT_EQ(left_out("5", ""), "air has neither drag nor mass");
  EXPECT_EQ(left_out("10", ""),
            "air has neither drag nor mass: on what moves across itself at 10 m/s its drag would be "
            "0.36 of the weight (air = {density = \"1.2 kg/m^3\"} in [environment])");
  EXPECT_EQ(left_out("10", "air = {density = 1.2}\n"),
            "air has no mass, and no flow of its own that a film would flap in");
  EXPECT_EQ(
      left_out("10", "air = {density = 1.2}\n[[solid]]\nshape = \"plane\"\n"),
      "air has no mass, and no flow of its own that a film would flap in, and does not drive what touches a solid");
}

TEST(Explain, NumbersByTheirFormulas) {
  // L = 1, h = 0.02, mu = 100, rho = 1000, gamma = 0.05, g = 10
  const Explanation e = of(disk + liquid +
                           "surface_tension = 0.05\n[environment]\ngravity = [0, 0, -10]\n"
                           "bath = {density = 2000}\n[[hold]]\nregion = \"rim\"\n"
                           "motion = {kind = \"translating\", velocity = [3.25, 0, 0]}\n");
  const double V = 3.25; // the bath carries the weight, so gravity does not drive it
  EXPECT_DOUBLE_EQ(scale(e, "L"), 1);
  EXPECT_DOUBLE_EQ(scale(e, "h"), 0.02);
  EXPECT_DOUBLE_EQ(scale(e, "V"), V);
  EXPECT_DOUBLE_EQ(scale(e, "t_V"), 1 / V);
  EXPECT_DOUBLE_EQ(scale(e, "t_g"), 100 / (1000 * 10.0));
  EXPECT_DOUBLE_EQ(scale(e, "t_f"), std::sqrt(0.1));
  EXPECT_DOUBLE_EQ(scale(e, "t_c"), 100 * 0.02 / 0.05);
  EXPECT_DOUBLE_EQ(scale(e, "t_p"), 0);
  EXPECT_DOUBLE_EQ(scale(e, "lambda"), 2 * std::numbers::pi * std::sqrt((4 * 100 * 0.02 * V - 0.1) / (2 * 2000 * 10)));
  EXPECT_DOUBLE_EQ(number(e, "thickness to length")->value, 0.02);
  EXPECT_DOUBLE_EQ(number(e, "bending to stretching")->value, 0.0004);
  EXPECT_DOUBLE_EQ(number(e, "Reynolds")->value, 1000 * V / 100);
  EXPECT_DOUBLE_EQ(number(e, "capillary")->value, 100 * V / 0.05);
  EXPECT_DOUBLE_EQ(number(e, "Bond")->value, 1000 * 10 / 0.05);
  EXPECT_DOUBLE_EQ(number(e, "Bond of the bath")->value, 2000 * 10 / 0.05);
  EXPECT_DOUBLE_EQ(number(e, "density to the bath's")->value, 0.5);
  EXPECT_NEAR(number(e, "buckling")->value, 12 * 2500 / (std::numbers::pi * std::numbers::pi), 1e-9);
  EXPECT_EQ(number(e, "capillary")->meaning,
            "In the sheet viscous stress rules over surface tension. (mu V h / (gamma L) = 130)");
  EXPECT_EQ(number(e, "Bond")->meaning, "In the sheet weight rules over surface tension. (rho g L h / gamma = 4e+03)");
  EXPECT_THAT(e.warnings, IsEmpty());
}

TEST(Explain, TheFastestDriveGivesTheSpeed) {
  EXPECT_DOUBLE_EQ(scale(of(disk + liquid + "[environment]\npressure = {law = \"constant\", value = -2}\n"), "V"),
                   std::sqrt(2 / (1000 * 0.02))); // less than p L²/(mu h) = 1
  EXPECT_DOUBLE_EQ(scale(of(disk + liquid + "surface_tension = 3\n"), "V"), std::sqrt(2 * 3 / (1000 * 0.02)));
  EXPECT_DOUBLE_EQ(scale(of(disk + liquid + "[inflow]\nregion = \"rim\"\nvelocity = [0, -3, 4]\n"), "V"), 5);
  EXPECT_DOUBLE_EQ(scale(of(disk + liquid + "[[solid]]\nshape = \"plane\"\nsurface_velocity = [0, 0, 0.4]\n"), "V"),
                   0.4);
  EXPECT_DOUBLE_EQ(
      scale(of("[sheet]\nshape = \"disk\"\nradius = 2\nedge_length = 0.1\nthickness = 0.2\n" + liquid +
               "[[hold]]\nregion = \"rim\"\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = 0.3}\n"),
            "V"),
      0.6);
}

// What lies on ground is not drawn out by its weight, at 100 m/s, but spreads, at rho g h³/(3 mu L) = 0.27 mm/s.
TEST(Explain, TheGroundCarriesWhatLiesOnIt) {
  const Scene scene = parse_scene(disk + "[material]\nviscosity = 1e4\ndensity = 1e5\n[environment]\n"
                                         "gravity = [0, -10, 0]\n[model]\ninertia = false\n"
                                         "[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n",
                                  "s");
  const auto warned = [](const Explanation& e, std::string_view words) {
    return std::ranges::any_of(e.warnings, [&](const std::string& w) { return w.find(words) != w.npos; });
  };
  Measured lies{.length = 1, .thickness = 0.02, .curvature = {}};
  EXPECT_TRUE(warned(explain(scene, std::array{lies}), "inertia is off"));
  lies.lies = true;
  EXPECT_DOUBLE_EQ(scale(explain(scene, std::array{lies}), "V"), scale(explain(scene, std::array{lies}), "U"));
  EXPECT_FALSE(warned(explain(scene, std::array{lies}), "inertia is off"));
}

// As thin as molten lead a layer would spread at 1 km/s by its drag alone: it is not faster than sqrt(2 g L).
TEST(Explain, NothingSpreadsFasterThanItFalls) {
  const Scene scene = parse_scene(disk + "[material]\nviscosity = 0.0025\ndensity = 10600\n[environment]\n"
                                         "gravity = [0, -10, 0]\n[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n",
                                  "s");
  Measured lies{.length = 1, .thickness = 0.02, .curvature = {}};
  lies.lies = true;
  EXPECT_DOUBLE_EQ(scale(explain(scene, std::array{lies}), "V"), std::sqrt(2 * 10 * 1));
  EXPECT_GT(scale(explain(scene, std::array{lies}), "U"), 100);
}

// p = cd rho_a v²/2 = 6.48 Pa. What is held creeps in the wind; what is free goes along with it.
TEST(Explain, WindTakesAlongWhatIsFree) {
  const std::string windy = disk + "[material]\nviscosity = 1e6\ndensity = 1000\n[environment]\n"
                                   "air = {density = 1.2, drag_coefficient = 1.2, wind = [0, 0, 3]}\n";
  EXPECT_DOUBLE_EQ(scale(of(windy), "V"), std::sqrt(6.48 / (1000 * 0.02)));
  EXPECT_LT(scale(of(windy + "[[hold]]\nregion = \"rim\"\n"), "V"), 1e-3);
  // On what floats it rubs on one face, 0.5 ct rho_a v²/2 = 0.027 Pa.
  const std::string afloat = windy + "gravity = [0, -10, 0]\nbath = {density = 2000, level = 0";
  EXPECT_DOUBLE_EQ(scale(of(afloat + "}\n"), "V"), std::sqrt(0.027 / (1000 * 0.02)));
  EXPECT_DOUBLE_EQ(scale(of(afloat + ", drag = 27}\n"), "V"), 0.001);
}

TEST(Explain, MeshesAreAsTheyAreMeasured) {
  const Scene mesh = parse_scene("[sheet]\nshape = \"mesh\"\nfile = \"a.off\"\nthickness = 0.1\n" + liquid, "s");
  EXPECT_THAT(explain(mesh).numbers, IsEmpty());
  EXPECT_DOUBLE_EQ(
      number(explain(mesh, std::array{Measured{.length = 2, .thickness = {}, .curvature = {}}}), "thickness to length")
          ->value,
      0.05);
}

TEST(Explain, Warnings) {
  const std::string fall = "[environment]\ngravity = [0, -10, 0]\n", creep = "[model]\ninertia = false\n";
  const std::string hold = "[[hold]]\nregion = \"rim\"\n";
  EXPECT_THAT(of(disk + liquid).warnings, ElementsAre("nothing drives the sheet: it stays as it is"));
  EXPECT_THAT(of(disk + liquid + fall).warnings, ElementsAre("nothing holds or catches the sheet: it falls for ever"));
  EXPECT_THAT(
      of(disk + liquid + fall + creep).warnings,
      ElementsAre("inertia is off, but the Reynolds number is 1e+03: the real sheet would move differently",
                  "creeping flow under gravity without hold, bath or inflow: nothing resists the fall, there is no "
                  "solution"));
  EXPECT_THAT(of(disk + "[material]\nviscosity = 1e8\ndensity = 1000\n" + fall + hold).warnings,
              ElementsAre("inertia is on, but the Reynolds number is 1e-09: inertia = false gives the same motion"));
  EXPECT_THAT(
      of("[sheet]\nshape = \"sphere\"\nradius = 1\nedge_length = 0.5\nthickness = 0.01\n" + liquid +
         "surface_tension = 1\n")
          .warnings,
      ElementsAre(
          "edge_length 0.5 m is above sqrt(h / curvature) = 0.1 m: flat triangles resist bending too much "
          "there",
          "edges of 0.5 m are above sqrt(h / curvature) / 2 = 0.05 m: if the sheet buckles, the mesh decides how"));
  EXPECT_THAT(
      of("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.3\n" + liquid + fall + hold).warnings,
      ElementsAre("edge_length 0.1 m is below the thickness 0.3 m: a sheet has no detail that fine",
                  "the sheet is thicker than a fifth of its length: the equations of thin sheets are doubtful"));
}

// Without inertia nothing resists a fall, onto a bath or when a hold lets go.
TEST(Explain, LeavesInertiaToWhatFallsAtSomeTime) {
  const auto warned = [](const std::string& more, double above_bath, std::string_view words) {
    const Scene scene = parse_scene(disk + "[material]\nviscosity = 1e8\ndensity = 1000\n" + more, "s");
    const std::array measured{Measured{.length = 2, .thickness = 0.01, .curvature = {}, .above_bath = above_bath}};
    return std::ranges::any_of(explain(scene, measured).warnings,
                               [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  };
  const std::string fall = "[environment]\ngravity = [0, -10, 0]\n",
                    bath = fall + "bath = {density = 2000}\npressure = {law = \"constant\", value = 1}\n";
  const std::string hold = "[[hold]]\nregion = \"rim\"\n", let_go = hold + "until = 1\n";
  const std::string_view advice = "inertia = false gives the same motion";
  EXPECT_TRUE(warned(bath, 0, advice));
  EXPECT_FALSE(warned(bath, 0.1, advice));
  EXPECT_TRUE(warned(fall + hold, 0, advice));
  EXPECT_FALSE(warned(fall + let_go, 0, advice));
  const std::string creep = "[model]\ninertia = false\n";
  const std::string_view unsolvable = "there is no solution then";
  EXPECT_FALSE(warned(bath + creep, 0, unsolvable));
  EXPECT_TRUE(warned(bath + creep, 0.1, unsolvable));
  EXPECT_FALSE(warned(fall + creep + hold, 0, unsolvable));
  EXPECT_TRUE(warned(fall + creep + let_go, 0, unsolvable));
}

TEST(Explain, DoubtsThicknessesThatMayBeMillimetres) {
  const Scene scene = parse_scene("[sheet]\nshape = \"mesh\"\nfile = \"leaf.ply\"\nscale = 0.001\n"
                                  "thickness = {data = \"h\", place = \"vertex\"}\n" +
                                      liquid,
                                  "s");
  const auto thick = [&](double thickness) {
    const std::array measured{Measured{.length = 0.08, .thickness = thickness, .curvature = {}}};
    return explain(scene, measured).warnings;
  };
  EXPECT_THAT(thick(3), testing::Contains(testing::HasSubstr(
                            "doubtful; its data make it 3 m thick: if they are in millimetres, scale = 0.001")));
  EXPECT_THAT(thick(0.02), testing::Contains(testing::EndsWith("thin sheets are doubtful")));
  const auto plain = [&](const std::string& thickness) {
    return of("[sheet]\nshape = \"disk\"\nradius = 0.05\nedge_length = 0.01\nthickness = " + thickness + "\n" + liquid)
        .warnings;
  };
  EXPECT_THAT(plain("3"), testing::Contains(testing::EndsWith("doubtful; it is 3 m thick: write \"3 mm\" if you mean "
                                                              "that; numbers without unit are metres")));
  EXPECT_THAT(plain("0.03"), testing::Contains(testing::EndsWith("thin sheets are doubtful")));
}

// On a ball liquid may come to hang below; on a level plate it cannot, and with an adhesion it drips off.
TEST(Explain, TellsThatNothingDripsOff) {
  const std::string disk = "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.02\n" + liquid +
                           "[environment]\ngravity = [0, -9.81, 0]\n";
  const auto told = [&](const std::string& more) {
    return std::ranges::count(of(disk + more).left_out,
                              "what comes to hang below a solid never drips off ([contact] adhesion)");
  };
  const std::string ball = "[[solid]]\nshape = \"sphere\"\nradius = 1\ncontact = \"flow\"\n";
  EXPECT_EQ(told(ball), 1);
  EXPECT_EQ(told(ball + "[contact]\nadhesion = 10\n"), 0);
  EXPECT_EQ(told("[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n"), 0);
}

// Edges that do not resolve sqrt(R h) = 0.1 m; 60 around are 0.105 m long, 130 less than half of it.
TEST(Explain, WarnsWhereTheMeshWouldDecideHowItBuckles) {
  const auto cap = [](std::string_view mesh, std::string_view rest) {
    return of(fmt::format("[sheet]\nshape = \"cap\"\nradius = 1\nangle = \"90 deg\"\nopening = \"30 deg\"\n{}\n"
                          "thickness = 0.01\n{}{}",
                          mesh, liquid, rest));
  };
  const std::string tension = "surface_tension = 1\n", buckles = "if the sheet buckles, the mesh decides how";
  const auto warned = [&](const Explanation& e) {
    return std::ranges::any_of(e.warnings, [&](const std::string& w) { return w.find(buckles) != std::string::npos; });
  };
  EXPECT_TRUE(warned(cap("segments = [60, 130]", tension)));
  EXPECT_TRUE(warned(cap("segments = [130, 10]", tension)));
  EXPECT_FALSE(warned(cap("segments = [130, 30]", tension)));
  EXPECT_TRUE(warned(cap("edge_length = 0.06", tension)));
  EXPECT_FALSE(warned(cap("edge_length = 0.04", tension)));
  EXPECT_FALSE(warned(cap("edge_length = 0.06", "")));
  EXPECT_FALSE(warned(cap("edge_length = 0.06", tension + "[model]\nbending = false\n")));
  EXPECT_FALSE(
      warned(cap("edge_length = 0.06", tension + "[environment]\npressure = {law = \"constant\", value = 4}\n")));
}

TEST(Explain, Text) {
  const Scene scene = parse_scene(disk + liquid + "[environment]\npressure = {law = \"constant\", value = 2}\n", "s");
  EXPECT_EQ(
      to_text(explain(scene, {}, {{"pressure", true, "constant, 2 Pa"}, {"tear", false, "the sheet only thins"}})),
      R"(Modelled
  pressure        constant, 2 Pa

Not modelled, and at no cost
  tear            the sheet only thins

Scales
  L               1 m    length: the shape's shortest side, radius or width
  h            0.02 m    thickness: the sheet's, at the start
  V           0.316 m/s  speed: the fastest drive: pressure
  t_V          3.16 s    time of the flow: L / V
  t_p             1 s    time in which pressure stretches it: mu h / (p L)

Dimensionless numbers
  thickness to length = h / L = 0.02
      Thin: it folds and wrinkles far more easily than it stretches.
  bending to stretching = (h / L)² = 0.0004
      Bending by a length L dissipates 0.0004 of what stretching does.
  buckling = (12 / pi²) (L / h)² = 3.04e+03
      Under compression it buckles 3.04e+03 times as fast as it thickens.
  Reynolds = rho V L / mu = 3.16
      Viscosity and inertia both matter.

Left out: air has neither drag nor mass
)");
}

} // namespace
} // namespace sheet::scene
