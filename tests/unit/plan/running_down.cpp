// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/running_down.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/plan/slopes.h"
#include "libsheet/scene/read.h"
#include "tests/unit/own_path.h"

namespace sheet {
namespace {

// 4 mm of honey on a board that leans by this angle.
std::optional<RunningDown> honey_on(double degrees, const std::string& contact = "flow", double above = 0,
                                    const std::string& motion = "") {
  const double a = degrees * std::numbers::pi / 180, height = 0.002 + above;
  return [&](const std::string& text) {
    const Scene scene = scene::parse_scene(text, "s");
    return runs_down(scene, first_frame(scene), 2);
  }(fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.01\nthickness = 0.004\n"
                "center = [0, {}, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
                "gravity = [{}, {}, 0]\n[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"{}\"\n{}",
                height, 9.81 * std::sin(a), -9.81 * std::cos(a), contact, motion));
}

TEST(RunningDown, TheSpeedIsTheFilms) {
  const auto honey = honey_on(30);
  ASSERT_TRUE(honey);
  const double u = 1400 * 9.81 / 2 * 0.004 * 0.004 / (3 * 10); // [Nusselt 1916]
  EXPECT_NEAR(honey->speed, u, 1e-9 * u);
  EXPECT_NEAR(honey->time, 0.1 / u, 1e-6 * 0.1 / u);
}

TEST(RunningDown, NotWhereItIsLevelOrSticksOrFalls) {
  EXPECT_FALSE(honey_on(2));
  EXPECT_FALSE(honey_on(30, "stick"));
  EXPECT_FALSE(honey_on(30, "slip"));
  EXPECT_FALSE(honey_on(30, "flow", 0.01));
}

// Icing that falls on a ball, and on a box.
TEST(RunningDown, WhatLandsRunsDownLater) {
  const auto warning = [](const std::string& solid, const std::string& contact, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"disk\"\nradius = 0.03\nedge_length = 0.005\nthickness = 0.004\ncenter = [0, 0.05, 0]\n"
        "[material]\nviscosity = 20\ndensity = 1300\n[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\n" +
            solid + "contact = \"" + contact + "\"\n",
        "s");
    return late_running_warning(scene, first_frame(scene), until);
  };
  const std::string ball = "shape = \"sphere\"\nradius = 0.04\n", box = "shape = \"box\"\nsize = [0.1, 0.05, 0.1]\n";
  EXPECT_THAT(
      warning(ball, "flow", 1),
      testing::StartsWith("the run ends, at 1 s, before what lands on solid 0 (sphere) has run down, which takes "
                          "some "));
  EXPECT_EQ(warning(ball + "angular_velocity = [0, 0, 1]\n", "flow", 1), ""); // it is carried round
  EXPECT_EQ(warning(ball, "flow", 60), "");
  EXPECT_EQ(warning(ball, "flow", 1e-3), "");
  EXPECT_EQ(warning(ball, "stick", 1), "");
  EXPECT_EQ(warning(box, "flow", 1), "");
}

// A disk with V = 11.3 ml of 0.0154 m²/s: from a radius of 30 to 33 mm in 3 nu/(g V³) (r/0.894)⁸ = 6.0 s.
TEST(RunningDown, WhatLandsOnLevelGroundSpreadsLater) {
  const auto warning = [](const std::string& solid, const std::string& of_liquid, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"disk\"\nradius = 0.03\nedge_length = 0.005\nthickness = 0.004\ncenter = [0, 0.05, 0]\n"
        "[material]\ndensity = 1300\n" +
            of_liquid + "[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\n" + solid,
        "s");
    return late_spreading_warning(scene, first_frame(scene), until);
  };
  const std::string plane = "shape = \"plane\"\ncontact = \"flow\"\n", icing = "viscosity = 20\n";
  const std::string belt = plane + "surface_velocity = [0.3, 0, 0]\n";
  EXPECT_NE(warning(belt, icing, 1), "");
  EXPECT_EQ(warning(belt + "[[outflow]]\npoint = [0.3, 0, 0]\nnormal = [1, 0, 0]\n", icing, 1), "");
  EXPECT_THAT(warning(plane, icing, 1),
              testing::StartsWith("the run ends, at 1 s, before what lands on solid 0 (plane) has spread by a tenth, "
                                  "which takes some 6"));
  EXPECT_EQ(warning(plane, icing, 5), "");
  EXPECT_EQ(warning(plane, "viscosity = 2e5\n", 1), ""); // putty: 17 hours
  EXPECT_EQ(warning(plane, icing + "surface_tension = 0.1\n", 1), "");
  EXPECT_EQ(warning("shape = \"plane\"\n", icing, 1), "");
  EXPECT_EQ(warning(plane + "[[solid]]\nshape = \"sphere\"\nradius = 0.01\ncenter = [0, 0.1, 0]\n"
                            "velocity = [0, -0.1, 0]\n",
                    icing, 1),
            "");
  EXPECT_EQ(warning("shape = \"sphere\"\nradius = 0.04\ncontact = \"flow\"\n", icing, 1), "");
}

// An ice cap: by Halfar's solution from a radius of 100 to 110 km in 9.90e8 s. One that lies there has nothing else to
// do, so that the run goes on until it has.
TEST(RunningDown, WhatLiesOnLevelGroundSpreadsByItsLaw) {
  const auto scene = [](double height, const std::string& law) {
    return scene::parse_scene(fmt::format("[sheet]\nshape = \"disk\"\nradius = 1e5\nsegments = [16, 48]\n"
                                          "thickness = 2000\ncenter = [0, {}, 0]\n[material]\ndensity = 910\n"
                                          "viscosity = 7e14\n{}[environment]\ngravity = [0, -9.81, 0]\n[model]\n"
                                          "inertia = false\n[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n",
                                          height, law),
                              "s");
  };
  const std::string ice = "law = \"power\"\nflow_index = 0.3333333333333333\nreference_rate = 1e-10\n";
  const Scene lying = scene(1000, ice), above = scene(5000, ice);
  const auto first = first_frame(lying);
  const auto spreading = spreads(lying, first);
  ASSERT_TRUE(spreading);
  EXPECT_TRUE(spreading->lies);
  const double radius = *measured(first).length / std::sqrt(std::numbers::pi); // of a circle of the polygon's area
  EXPECT_NEAR(spreading->time, 9.898e8 * std::pow(radius / 1e5, 4), 1e5);
  EXPECT_GE(proposed_ring(lying, first, {}).until, 2 * spreading->time);
  EXPECT_TRUE(measured_on_solids(lying, first)[0].lies);
  ASSERT_TRUE(spreads(above, first_frame(above)));
  EXPECT_FALSE(spreads(above, first_frame(above))->lies);
  EXPECT_LT(proposed_ring(above, first_frame(above), {}).until, 1000);
  EXPECT_FALSE(measured_on_solids(above, first_frame(above))[0].lies);
  EXPECT_FALSE(spreads(scene(1000, "law = \"bingham\"\nyield_stress = 1e5\n"), first));
}

// On a board that turns until it is steep.
TEST(RunningDown, WhenTheSolidHasTurned) {
  const auto honey =
      honey_on(0, "flow", 0,
               "motion = {kind = \"rotating\", axis = [0, 0, 1], rate = [[0, \"30 deg/s\"], [1, \"30 deg/s\"], "
               "[1.001, 0]]}\n");
  ASSERT_TRUE(honey);
  EXPECT_NEAR(honey->speed, honey_on(30)->speed, 1e-3 * honey->speed);
}

// A drop of honey on a disk that turns about its axis [Emslie, Bonner, Peck 1958]; a slow one hardly drives it.
TEST(RunningDown, ATurningDiskDrivesItOutwards) {
  const auto spun = [](double rate) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"disk\"\nradius = 0.03\nedge_length = 0.003\nthickness = 0.002\n"
                    "center = [0.2, 0.001, 0]\n[material]\nviscosity = 5\ndensity = 1400\n[environment]\n"
                    "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"cylinder\"\nradius = 0.1\nheight = 0.01\n"
                    "center = [0.2, -0.005, 0]\ncontact = \"flow\"\nangular_velocity = [0, {}, 0]\n",
                    rate),
        "s");
    return runs_down(scene, first_frame(scene), 0);
  };
  const auto honey = spun(30);
  ASSERT_TRUE(honey);
  const double u = 1400 * 30 * 30 * 0.02 * 0.002 * 0.002 / (3 * 5); // at the disk's mean radius
  EXPECT_NEAR(honey->speed, u, 0.05 * u);
  EXPECT_FALSE(spun(3));
}

// A sheet runs as its own liquid does, whatever [material] says.
TEST(RunningDown, ASheetOfAnotherLiquidRunsAsThat) {
  const Scene scene = scene::parse_scene(
      "[[sheet]]\nname = \"glaze\"\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.01\n"
      "thickness = 0.004\ncenter = [0, 0.002, 0]\n[sheet.material]\nviscosity = 2\ndensity = 1200\n"
      "[[sheet]]\nname = \"far\"\nshape = \"rectangle\"\nsize = [0.02, 0.02]\nedge_length = 0.01\n"
      "thickness = 0.004\ncenter = [0, 1, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
      "gravity = [4.905, -8.496, 0]\n[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"flow\"\n",
      "s");
  const auto glaze = runs_down(scene, first_frame(scene), 2);
  ASSERT_TRUE(glaze);
  const double u = 1200 * 4.905 * 0.004 * 0.004 / (3 * 2);
  EXPECT_NEAR(glaze->speed, u, 1e-9 * u);
}

// What flows in for ever runs as thick as it carries that, (3 nu q/g_t)^(1/3); what ends, as the sheet is.
TEST(RunningDown, WhatFlowsInRunsAsThickAsItCarriesThat) {
  const auto running = [](const std::string& until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.04]\nedge_length = 0.005\nthickness = 0.004\n"
        "center = [0, 0.002, 0]\n[material]\nviscosity = 10\ndensity = 1000\n[environment]\n"
        "gravity = [4.905, -8.496, 0]\n[[inflow]]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n" +
            until + "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"flow\"\n",
        "s");
    return runs_down(scene, first_frame(scene), 0)->speed;
  };
  const double flux = 0.004 * 0.1, speed = flux / std::cbrt(3 * 0.01 * flux / 4.905);
  EXPECT_NEAR(running(""), speed, 1e-6 * speed);
  const double thin = 1000 * 4.905 * 0.004 * 0.004 / (3 * 10);
  EXPECT_NEAR(running("until = 1\n"), thin, 1e-9 * thin);
}

// Icing of 40 ml, 8 mm thick, that lands on a cake of 100 by 100 mm, 70 mm high.
TEST(RunningDown, WhatLandsOnATopComesOverItsEdgeLater) {
  const auto late = [](const std::string& of_liquid, const std::string& tables, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"disk\"\nradius = 0.04\nedge_length = 0.005\nthickness = 0.008\ncenter = [0, 0.08, 0]\n"
        "[material]\nviscosity = 10\ndensity = 1000\n" +
            of_liquid +
            "[environment]\ngravity = [0, -10, 0]\n[[solid]]\nshape = \"box\"\nsize = [0.1, 0.07, 0.1]\n"
            "center = [0, 0.035, 0]\ncontact = \"flow\"\n" +
            tables,
        "s");
    return late_overrun_warning(scene, first_frame(scene), until);
  };
  const double volume = std::numbers::pi * 0.04 * 0.04 * 0.008;
  const double spreading = std::pow(0.05 / 0.894, 8) * 3 * 0.01 / (10 * std::pow(volume, 3)); // [Huppert 1982]
  const double running = std::sqrt(std::numbers::pi) * 0.04 / 2 / (10 * 0.004 * 0.004 / (3 * 0.01));
  const double time = std::sqrt(2 * 0.01 / 10) + spreading + running;
  const std::string words =
                        "the run ends, at 1 s, before what lands on solid 0 (box) has come over its edge and run down "
                        "it, which takes some ",
                    told = late("", "", 1);
  ASSERT_THAT(told, testing::StartsWith(words));
  EXPECT_NEAR(std::stod(told.substr(words.size())), time, 0.15 * time); // its middle is that of some vertices
  EXPECT_EQ(late("", "", time / 1.5), "");
  EXPECT_EQ(late("", "", time / 50), "");
  EXPECT_EQ(late("surface_tension = 0.1\n", "", 1), ""); // 2 l_c are 6 mm
  EXPECT_EQ(late("", "[[hold]]\nregion = \"rim\"\n", 1), "");
  const auto walls = [](double from_middle, double thickness) {
    std::string text;
    for (const double x : {-from_middle, from_middle})
      text += fmt::format("[[solid]]\nshape = \"box\"\nsize = [{0}, 0.2, 0.1]\ncenter = [{1}, 0, 0]\n[[solid]]\n"
                          "shape = \"box\"\nsize = [0.1, 0.2, {0}]\ncenter = [0, 0, {1}]\n",
                          thickness, x);
    return text;
  };
  EXPECT_EQ(late("", walls(0.048, 0.004), 1), ""); // that stand on it
  EXPECT_EQ(late("", walls(0.1, 0.1), 1), "");     // beside it
}

// A jar, 100 mm wide inside, with walls of 4 mm that are 60 mm high: what is poured into it stays there.
TEST(RunningDown, WhatLandsInAVesselDoesNotComeOverItsEdge) {
  const std::string file = test::own_path("jar.obj");
  {
    std::ofstream obj(file);
    const auto ring = [&](double half, double y) { // four corners
      for (const auto& [x, z] : {std::pair(-half, -half), {-half, half}, {half, half}, {half, -half}})
        obj << fmt::format("v {} {} {}\n", x, y, z);
    };
    ring(0.054, 0), ring(0.054, 0.064), ring(0.05, 0.064), ring(0.05, 0.004);
    obj << "f 4 3 2 1\nf 13 14 15 16\n";
    for (int side = 0; side < 3; ++side)
      for (int k = 0; k < 4; ++k) {
        const int a = 4 * side + k + 1, b = 4 * side + (k + 1) % 4 + 1;
        obj << fmt::format("f {} {} {} {}\n", a, b, b + 4, a + 4);
      }
  }
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.02]\nplane = \"xy\"\nedge_length = 0.005\n"
                  "thickness = 0.005\ncenter = [0, 0.1, 0]\n[material]\nviscosity = 10\ndensity = 1000\n"
                  "[environment]\ngravity = [0, -10, 0]\n[inflow]\nregion = \"y_max\"\nvelocity = [0, -0.1, 0]\n"
                  "[[solid]]\nshape = \"mesh\"\nfile = \"{}\"\ncontact = \"flow\"\n",
                  file),
      "s");
  EXPECT_EQ(late_overrun_warning(scene, first_frame(scene), 1), "");
}

// Icing, 10 ml/s, that is poured on a cake 100 mm in diameter, 50 mm high.
TEST(RunningDown, WhatIsPouredOnATopComesOverItsEdgeLater) {
  const auto late = [](const std::string& of_inflow, const std::string& tables, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nplane = \"xy\"\nsize = [0.02, 0.01]\nedge_length = 0.005\n"
        "thickness = 0.005\ncenter = [0, 0.08, 0]\n[material]\nviscosity = 10\ndensity = 1000\n[environment]\n"
        "gravity = [0, -10, 0]\n[[solid]]\nshape = \"cylinder\"\nradius = 0.05\nheight = 0.05\n"
        "center = [0, 0.025, 0]\ncontact = \"flow\"\n" +
            tables + "[[inflow]]\nregion = \"y_max\"\n" + of_inflow,
        "s");
    return late_overrun_warning(scene, first_frame(scene), until);
  };
  const double nu = 0.01, flux = 1e-5, around = flux / (2 * std::numbers::pi * 0.05);
  const double side = 0.05 / std::cbrt(10 * around * around / (3 * nu));
  const auto time = [&](double spreading) { return std::sqrt(2 * 0.03 / 10) + spreading + side; };
  const std::string words =
      "the run ends, at 1 s, before what lands on solid 0 (cylinder) has come over its edge and run down it, which "
      "takes some ";
  const std::string straight = "velocity = [0, -0.1, 0]\n", for_ever = late(straight, "", 1),
                    ends = late(straight + "until = 3\n", "", 1);
  ASSERT_THAT(for_ever, testing::StartsWith(words));
  const double of_flux = time(std::pow(0.05 / 0.715, 2) * std::pow(3 * nu / (10 * std::pow(flux, 3)), 0.25));
  EXPECT_NEAR(std::stod(for_ever.substr(words.size())), of_flux, 0.05 * of_flux); // [Huppert 1982]
  ASSERT_THAT(ends, testing::StartsWith(words));
  const double of_volume = time(std::pow(0.05 / 0.894, 8) * 3 * nu / (10 * std::pow(3 * flux, 3)));
  EXPECT_NEAR(std::stod(ends.substr(words.size())), of_volume, 0.05 * of_volume);
  EXPECT_EQ(late(straight, "", of_flux / 1.5), "");
  EXPECT_EQ(late("velocity = [0.1, -0.1, 0]\n", "", 1), ""); // aslant
  EXPECT_EQ(late(straight, "[[hold]]\nregion = \"x_min\"\n", 1), "");
}

// Paint with brush marks, which tension keeps from spreading.
TEST(RunningDown, TheRunGoesOnUntilWavesHaveLevelled) {
  const auto paint = [](const std::string& perturbation, const std::string& more) {
    return scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.04]\nedge_length = 0.005\nthickness = 0.001\n"
        "center = [0, 0.0005, 0]\n" +
            perturbation +
            "[material]\nviscosity = 2\ndensity = 1200\nsurface_tension = 0.03\n[environment]\n"
            "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\ncontact = \"flow\"\n" +
            more,
        "s");
  };
  const auto time = [](const Scene& scene) { return levelling_time(scene, first_frame(scene)); };
  const auto until = [](const Scene& scene) { return proposed_ring(scene, first_frame(scene), {}).until; };
  const std::string wave = "perturbation = {of = \"thickness\", amplitude = 1e-4, wavelength = 0.02}\n";
  const double k = 2 * std::numbers::pi / 0.02, h = 0.001, weight = 1200 * 9.81;
  const auto law = [&](double tension) {
    return 3 * 2 * (1 + 4 * k * k * h * h / 3) / (k * k * (weight + tension * k * k) * h * h * h);
  };
  EXPECT_NEAR(time(paint(wave, "")), law(0), 1e-4 * law(0));
  EXPECT_NEAR(time(paint(wave, "[model]\nfaces = true\n")), law(0.03), 1e-4 * law(0.03));
  EXPECT_NEAR(until(paint(wave, "")), 2 * law(0), 0.1 * law(0));
  const std::string small = "perturbation = {of = \"thickness\", amplitude = 1e-6, wavelength = 0.02}\n",
                    bend = "perturbation = {amplitude = 1e-5, wavelength = 0.02}\n",
                    held = "[[hold]]\nregion = \"rim\"\n";
  EXPECT_EQ(time(paint(small, "")), 0);
  EXPECT_EQ(time(paint(bend, "")), 0);
  EXPECT_LT(until(paint(small, "")), 1);
  EXPECT_EQ(time(paint(wave, held)), 0);
}

} // namespace
} // namespace sheet
