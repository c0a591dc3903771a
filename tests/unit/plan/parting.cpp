// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/parting.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// A sheet 4 mm thick that lies in the middle of a box, 0.3 m long along x.
std::optional<Parting> parting_of(const std::string& box, const std::string& contact = "[contact]\n",
                                  const std::string& gravity = "[0, -10, 0]") {
  const Scene scene = scene::parse_scene(R"([sheet]
shape = "rectangle"
size = [0.06, 0.06]
edge_length = 0.01
thickness = 0.004
center = [0, 0.002, 0]
[material]
viscosity = 100
density = 1000
[environment]
gravity = )" + gravity + R"(
[[solid]]
shape = "box"
size = [0.3, 0.1, 0.3]
center = [0, -0.05, 0]
)" + box + "\n" + contact,
                                         "s");
  return must_part(scene, checked_first_frame(scene), 1);
}

// Up at 1 m/s for 0.1 s, and then at once still: it flies 1²/(2 10) = 50 mm high. The weight is 40 Pa.
TEST(Parting, OfWhatIsThrownUp) {
  const std::string stops =
      R"(motion = {kind = "translating", velocity = [[0, 0, 1, 0], [0.1, 0, 1, 0], [0.10001, 0, 0, 0]]})";
  const auto parting = parting_of(stops);
  ASSERT_TRUE(parting);
  EXPECT_NEAR(parting->adhesion, 20, 1e-9);
  EXPECT_EQ(parting->why, "solid 0 (box) throws what lies on it 0.05 m up");
  EXPECT_FALSE(parting_of(stops, "[contact]\nadhesion = 1e9\n"));
  // slower, it flies 2 mm high, half of its thickness
  EXPECT_FALSE(parting_of(
      R"(motion = {kind = "translating", velocity = [[0, 0, 0.2, 0], [0.1, 0, 0.2, 0], [0.10001, 0, 0, 0]]})"));
  // and brought to rest in 0.2 s it stays where it is
  EXPECT_FALSE(
      parting_of(R"(motion = {kind = "translating", velocity = [[0, 0, 1, 0], [0.1, 0, 1, 0], [0.3, 0, 0, 0]]})"));
}

// The rim is 120 mm from the end.
TEST(Parting, OfWhatABeltCarriesPastItsEnd) {
  const auto parting = parting_of("surface_velocity = [0.2, 0, 0]");
  ASSERT_TRUE(parting);
  EXPECT_EQ(parting->why, "solid 0 (box) carries what lies on it past its end, from about 0.6 s on");
  EXPECT_FALSE(parting_of("surface_velocity = [0.1, 0, 0]")); // later than the run ends
  // turned, its velocity across its face is round-off
  const auto turned = parting_of("rotation = {axis = [1, 0, 0], angle = \"180 deg\"}\nsurface_velocity = [0, 0, -0.2]");
  ASSERT_TRUE(turned);
  EXPECT_EQ(turned->why, "solid 0 (box) carries what lies on it past its end, from about 0.6 s on");
}

// The rim is 120 mm from the end of a slippery box in the air, down which gravity pulls with 4 m/s².
TEST(Parting, OfWhatSlidesOverAnEdge) {
  const auto slides = [](const std::string& contact, const std::string& more = "", double sideways = 4) {
    return parting_of("contact = \"" + contact + "\"\n" + more, "[contact]\n", fmt::format("[{}, -9, 0]", sideways));
  };
  const auto parting = slides("slip");
  ASSERT_TRUE(parting);
  EXPECT_NEAR(parting->adhesion, 2 * std::hypot(4, 9), 1e-9);
  EXPECT_EQ(parting->why, "what lies on solid 0 (box) slides down over its edge, from about 0.25 s on");
  EXPECT_FALSE(slides("slip", "", 0.5)); // nearly level
  EXPECT_FALSE(slides("stick"));
  EXPECT_FALSE(slides("flow")); // at 1000 4 0.004²/(3 100) m/s it does not get there
  // on the ground the side of the box leads down to it
  EXPECT_FALSE(slides("slip", "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncenter = [0, -0.1, 0]\n"));
  EXPECT_TRUE(slides("slip", "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncenter = [0, -0.2, 0]\n"));
}

// It has 1e5 Pa s, and 10 Pa s when it is 80 K warmer, which takes 3 rho c h/(2 H) = 6 s; then it runs the 120 mm, and
// 2 mm round the edge, with 1000 4 0.004²/(3 10) m/s, within 57 s.
TEST(Parting, OfWhatRunsOverAnEdgeWhenItIsWarm) {
  const auto parting = [](const std::string& ambient, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\nthickness = 0.004\n"
        "center = [0, 0.002, 0]\n[material]\nviscosity = 1e5\ndensity = 1000\nviscosity_law = \"exponential\"\n"
        "reference_temperature = \"20 degC\"\ntemperature_coefficient = 0.11512925\n[heat]\nspecific_heat = 1000\n"
        "temperature = \"20 degC\"\ntransfer = 1000\nambient = \"" +
            ambient +
            "\"\n[environment]\ngravity = [4, -9, 0]\n[[solid]]\nshape = \"box\"\nsize = [0.3, 0.1, 0.3]\n"
            "center = [0, -0.05, 0]\ncontact = \"flow\"\n",
        "s");
    return must_part(scene, checked_first_frame(scene), until);
  };
  ASSERT_TRUE(parting("100 degC", 100));
  EXPECT_EQ(parting("100 degC", 100)->why, "what lies on solid 0 (box) runs down over its edge, from about 63 s on");
  EXPECT_FALSE(parting("100 degC", 50));
  EXPECT_FALSE(parting("20 degC", 100));
}

// 0.4 l a second and metre of 10 Pa s run down as a layer of (3 nu q/g_t)^(1/3) = 14.4 mm, and the 120 mm and round the
// edge with q/h = 27.7 mm/s; a layer of 4 mm takes 57 s.
TEST(Parting, OfWhatFlowsInAndRunsOverAnEdge) {
  const auto parting = [](const std::string& inflow, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\nthickness = 0.004\n"
        "center = [0, 0.002, 0]\n[material]\nviscosity = 10\ndensity = 1000\n[environment]\ngravity = [4, -9, 0]\n"
        "[inflow]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n" +
            inflow + "[[solid]]\nshape = \"box\"\nsize = [0.3, 0.1, 0.3]\ncenter = [0, -0.05, 0]\ncontact = \"flow\"\n",
        "s");
    return must_part(scene, checked_first_frame(scene), until);
  };
  ASSERT_TRUE(parting("", 10));
  EXPECT_EQ(parting("", 10)->why, "what lies on solid 0 (box) runs down over its edge, from about 4.4 s on");
  EXPECT_FALSE(parting("", 4));
  EXPECT_FALSE(parting("until = 1\n", 10));
}

// A raft 40 mm wide and 4 mm thick that flows in between a wall and the open bath, 70 mm before the wall's end; of its
// weight the bath leaves a tenth.
TEST(Parting, OfWhatFlowsInAlongAWallPastItsEnd) {
  const auto parting = [](const std::string& wall, double until) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.06, 0.04]\nedge_length = 0.01\nthickness = 0.004\n"
        "[material]\nviscosity = 100\ndensity = 900\n[environment]\ngravity = [0, -10, 0]\n"
        "bath = {density = 1000}\n[inflow]\nregion = \"x_min\"\nvelocity = [0.1, 0, 0]\n[[solid]]\nshape = \"box\"\n"
        "size = [0.2, 0.1, 0.02]\ncenter = [0, 0, 0.03]\n" +
            wall,
        "s");
    return must_part(scene, checked_first_frame(scene), until);
  };
  const auto past = parting("contact = \"slip\"\n", 10);
  ASSERT_TRUE(past);
  EXPECT_EQ(past->why, "inflow 0 drives what touches solid 0 (box) along it past its end, from about 0.72 s on");
  EXPECT_NEAR(past->adhesion, 90 * 10 * 0.004 / 2, 1e-9);
  EXPECT_FALSE(parting("contact = \"slip\"\n", 0.5));
  EXPECT_FALSE(parting("contact = \"stick\"\n", 10));
  EXPECT_FALSE(parting("contact = \"slip\"\n[[solid]]\nshape = \"box\"\nsize = [0.1, 0.1, 0.02]\n" // the wall goes on
                       "center = [0.15, 0, 0.03]\ncontact = \"slip\"\n",
                       0.8));
}

TEST(Parting, OfWhatABoxThatTiltsLetsSlide) {
  const auto tilts = [](double degrees) {
    return parting_of(fmt::format("contact = \"slip\"\nmotion = {{kind = \"rotating\", axis = [0, 0, 1], rate = [[0, "
                                  "\"{0} deg/s\"], [0.4, \"{0} deg/s\"], [0.401, 0]]}}\n",
                                  degrees / 0.4));
  };
  ASSERT_TRUE(tilts(40));
  EXPECT_EQ(tilts(40)->why, "what lies on solid 0 (box) slides down over its edge, from about 0.6 s on");
  EXPECT_FALSE(tilts(4));
  ASSERT_TRUE(tilts(150));
  EXPECT_EQ(tilts(150)->why, "solid 0 (box) turns over with what lies on it");
}

// A film, 2 mm thick, over two rolls that turn once in 4 s; it is 100 mm to either side of the first one.
TEST(Parting, OfWhatARollTurnsUnderItself) {
  const auto rolls = [](const std::string& of_liquid, double radius, const std::string& motion) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.1]\nedge_length = 0.01\nthickness = 0.002\n"
                    "center = [0, 0.001, 0]\n[material]\ndensity = 1000\n{}[environment]\n"
                    "gravity = [0, -10, 0]\n[[solid]]\nshape = \"cylinder\"\nradius = {}\nheight = 0.3\n"
                    "center = [0, {}, 0]\nrotation = {{axis = [1, 0, 0], angle = \"90 deg\"}}\n{}",
                    of_liquid, radius, -radius, motion),
        "s");
    return must_part(scene, first_frame(scene), 3);
  };
  const std::string turns = "angular_velocity = [0, 0, \"-15 rpm\"]\n";
  const std::string stiff = "viscosity = 5000\n", soft = "viscosity = 0.05\n";
  const auto parting = rolls(stiff, 0.02, turns);
  ASSERT_TRUE(parting);
  EXPECT_NEAR(parting->adhesion, 10, 1e-9);
  EXPECT_TRUE(parting->why.starts_with("solid 0 (cylinder) turns what lies on it under itself, from about "));
  EXPECT_TRUE(rolls(stiff + "surface_tension = 0.05\n", 0.02, turns)); // a film that goes on beyond it
  EXPECT_FALSE(rolls(stiff, 0.02, "angular_velocity = [0, 0, \"-1 rpm\"]\n"));
  EXPECT_FALSE(rolls(stiff, 0.02, "angular_velocity = [0, \"-15 rpm\", 0]\n")); // its face stays up
  EXPECT_TRUE(rolls(soft, 1, turns));                               // runs down a wall at 0.27 m/s, a sixth of 1.57 m/s
  EXPECT_FALSE(rolls(soft + "surface_tension = 0.05\n", 1, turns)); // lies wholly on it, and thinner than 4.5 mm
  EXPECT_FALSE(rolls(stiff, 1, turns));                             // is carried round
  EXPECT_TRUE(rolls(stiff, 1,
                    "motion = {kind = \"rotating\", axis = [0, 0, 1], rate = [[0, -1.57], [2, -1.57], "
                    "[2.01, 0]]}\n")); // and then hangs
}

// Honey all round a roll of 20 mm at 30 rpm, U = 0.063 m/s: it carries 0.7 (nu U/g)^½, 4.7 mm.
TEST(Parting, NotOfWhatARollCarriesRoundThatItIsWrappedIn) {
  const auto round = [](double thickness, double radius) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"tube\"\nradius = {}\nheight = 0.1\nplane = \"yz\"\nedge_length = 0.005\n"
                    "thickness = {}\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
                    "gravity = [0, -9.81, 0]\n[contact]\n[[solid]]\nshape = \"cylinder\"\nradius = 0.02\n"
                    "height = 0.14\nrotation = {{axis = [0, 0, 1], angle = \"90 deg\"}}\ncontact = \"flow\"\n"
                    "motion = {{kind = \"rotating\", axis = [1, 0, 0], rate = \"30 rpm\"}}\n",
                    radius, thickness),
        "s");
    return must_part(scene, first_frame(scene), 10);
  };
  EXPECT_FALSE(round(0.003, 0.0215));
  EXPECT_TRUE(round(0.006, 0.023));
  EXPECT_TRUE(round(0.003, 0.03)); // wide of it
}

// A ring of 2 mm on a disk of 42 mm that turns so fast that it drives outwards omega² r: at its edge 41 m/s² at 300
// rpm, 4.6 m/s² at 100 rpm. Its weight is 28 Pa.
TEST(Parting, OfWhatADiskFlingsOverItsEdge) {
  const auto parting = [](const std::string& rate, const std::string& more = "contact = \"flow\"\n",
                          double radius = 0.042) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"annulus\"\ninner_radius = 0.02\nouter_radius = 0.04\nedge_length = 0.005\n"
        "thickness = 0.002\ncenter = [0, 0.001, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\n"
        "gravity = [0, -10, 0]\n[contact]\n[[solid]]\nshape = \"cylinder\"\nradius = " +
            std::to_string(radius) +
            "\nheight = 0.02\ncenter = [0, -0.01, 0]\nmotion = {kind = \"rotating\", axis = [0, 1, 0], rate = " + rate +
            "}\n" + more,
        "s");
    return must_part(scene, checked_first_frame(scene), 10);
  };
  const auto flung = parting("\"300 rpm\"");
  ASSERT_TRUE(flung);
  EXPECT_NEAR(flung->adhesion, 14, 1e-9);
  EXPECT_THAT(flung->why, testing::StartsWith("solid 0 (cylinder) flings what lies on it over its edge, from about "));
  EXPECT_FALSE(parting("\"100 rpm\""));
  EXPECT_FALSE(parting("\"300 rpm\"", "contact = \"flow\"\n", 0.1)); // by ((r/r₀)⁴ - 1) 3 nu/(4 omega² h²) 50 s
  EXPECT_FALSE(parting("[[0, \"300 rpm\"], [1, \"300 rpm\"], [1.1, 0]]"));
  EXPECT_FALSE(parting("\"300 rpm\"", "contact = \"slip\"\n"));
}

TEST(Parting, OfWhatAHoldDrawsOverAnEdge) {
  const auto pulled = [](const std::string& velocity) {
    return parting_of(
        "contact = \"slip\"\n[[hold]]\nregion = \"x_max\"\nmotion = {kind = \"translating\", velocity = " + velocity +
        "}\n");
  };
  ASSERT_TRUE(pulled("[0.2, -0.05, 0]"));
  EXPECT_EQ(pulled("[0.2, -0.05, 0]")->why, "hold 0 draws what lies on solid 0 (box) over its edge");
  EXPECT_FALSE(pulled("[0.1, 0, 0]")); // it stays above the box
  EXPECT_FALSE(pulled("[0, 0.2, 0]"));
}

// The adhesion is that of the liquid that is thrown up, not of [material].
TEST(Parting, ASheetOfAnotherLiquidPartsAsThat) {
  const auto of = [](const std::string& own) {
    const Scene scene = scene::parse_scene(
        "[[sheet]]\nname = \"glaze\"\nshape = \"rectangle\"\nsize = [0.06, 0.06]\nedge_length = 0.01\n"
        "thickness = 0.004\ncenter = [0, 0.002, 0]\n" +
            own +
            "[material]\nviscosity = 100\ndensity = 1000\n"
            "[environment]\ngravity = [0, -10, 0]\n[[solid]]\nshape = \"box\"\nsize = [0.3, 0.1, 0.3]\n"
            "center = [0, -0.05, 0]\nsurface_velocity = [1, 0, 0]\n[contact]\n",
        "s");
    return must_part(scene, checked_first_frame(scene), 1);
  };
  const auto light = of(""), heavy = of("[sheet.material]\nviscosity = 100\ndensity = 3000\n");
  ASSERT_TRUE(light);
  ASSERT_TRUE(heavy);
  EXPECT_NEAR(heavy->adhesion, 3 * light->adhesion, 1e-9 * heavy->adhesion);
}

} // namespace
} // namespace sheet
