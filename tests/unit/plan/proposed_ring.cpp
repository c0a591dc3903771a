// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/proposed_ring.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

ProposedRing ring_of(const std::string& text) {
  const Scene scene = scene::parse_scene(text, "s");
  return proposed_ring(scene, first_frame(scene), {});
}

// Syrup of 3 mm, 80 by 60 mm, at this height over a bath.
ProposedRing over_bath(const std::string& height) {
  return ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.06]\nedge_length = 0.01\nthickness = 0.003\n"
                 "center = [0, " +
                 height +
                 ", 0]\n[material]\nviscosity = 50\ndensity = 900\nsurface_tension = 0.03\n[environment]\n"
                 "gravity = [0, -9.81, 0]\nbath = {density = 1000}\n");
}

// 0.2 m down in 0.2 s; on the bath its tension contracts it within ten seconds and more.
TEST(ProposedRing, FramesShowWhatFallsIntoABath) {
  EXPECT_GT(over_bath("0").until, 10);
  EXPECT_EQ(over_bath("0.2").until, over_bath("0").until);
  EXPECT_EQ(over_bath("0").fps, 5);
  EXPECT_EQ(over_bath("0.2").fps, 20);
}

// A slow pour of 200 Pa s from 103 mm up: it lands after 3.7 s at the latest.
TEST(ProposedRing, GoesOnPastTheLandingOfASlowPour) {
  EXPECT_GT(ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.006]\nedge_length = 0.003\nthickness = 0.004\n"
                    "plane = \"xy\"\ncenter = [0, 0.1, 0]\nvelocity = [0, -0.01, 0]\n[material]\nviscosity = 200\n"
                    "density = 1400\n[environment]\ngravity = [0, -9.81, 0]\n[inflow]\nregion = \"y_max\"\n"
                    "velocity = [0, -0.01, 0]\nthickness = 0.004\n[[solid]]\nshape = \"plane\"\n")
                .until,
            1.3 * 3.4);
}

// A curtain of syrup at 1 m/s comes to an outflow 0.5 m below in 0.23 s, past a post; a slow one of 200 Pa s, 0.1 m
// down, takes 3.4 s; of one that looks to the side nothing is known.
TEST(ProposedRing, GoesOnUntilACurtainHasComeToItsOutflow) {
  const auto until = [](const std::string& speed, const std::string& viscosity, const std::string& outflow) {
    const std::string velocity = "velocity = [0, -" + speed + ", 0]\n";
    return ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.02]\nedge_length = 0.01\nthickness = 0.001\n"
                   "plane = \"xy\"\n" +
                   velocity + "[material]\nviscosity = " + viscosity +
                   "\ndensity = 1400\n[environment]\ngravity = [0, -9.81, 0]\n[inflow]\nregion = \"y_max\"\n" +
                   velocity +
                   "[[solid]]\nshape = \"capsule\"\nradius = 0.01\nlength = 0.4\ncenter = [0.05, -0.2, 0.06]\n"
                   "[[outflow]]\n" +
                   outflow)
        .until;
  };
  const std::string below = "point = [0, -0.5, 0]\nnormal = [0, -1, 0]\n";
  EXPECT_GE(until("1", "3", below), 1.5 * 0.23);
  EXPECT_LT(until("1", "3", below), 2 * 0.23);
  EXPECT_GT(until("0.01", "200", "point = [0, -0.1, 0]\nnormal = [0, -1, 0]\n"), 1.3 * 3.4);
  EXPECT_LT(until("1", "3", "point = [0.5, 0, 0]\nnormal = [1, 0, 0]\n"), 0.23);
}

// A curtain 50 mm above a floor: 0.1 s from rest. At 8 m/s it is there within 6.2 ms, and has flowed in, 20 mm, in
// 2.5 ms; at 0.5 m/s it is not faster than it would fall.
TEST(ProposedRing, EndsSoonOfWhatIsShotDown) {
  const auto until = [](const std::string& speed) {
    const std::string velocity = "velocity = [0, -" + speed + ", 0]\n";
    return ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.02, 0.02]\nedge_length = 0.004\nthickness = 0.0005\n"
                   "plane = \"xy\"\ncenter = [0, 0.04, 0]\n" +
                   velocity +
                   "[material]\nviscosity = 0.01\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n[inflow]\n"
                   "region = \"y_max\"\n" +
                   velocity + "[[solid]]\nshape = \"plane\"\n")
        .until;
  };
  EXPECT_GT(until("0.5"), 4 * 0.1);
  EXPECT_LT(until("8"), 0.05);
  EXPECT_GT(until("8"), 5 * 0.0025);
}

// A layer of honey that creeps down a slope for a minute, over which a ball may pass in two seconds.
TEST(ProposedRing, FramesShowWhatEndsAtTheBeginning) {
  const std::string slope =
      "[sheet]\nshape = \"rectangle\"\nsize = [0.15, 0.06]\nedge_length = 0.01\nthickness = 0.004\n"
      "center = [0, 0.002, 0]\n[material]\nviscosity = 10\ndensity = 1400\n[environment]\ngravity = [2, -9.6, 0]\n"
      "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncontact = \"flow\"\n";
  const std::string ball = "[[solid]]\nshape = \"sphere\"\nradius = 0.02\ncenter = [-0.11, 0.021, 0]\n";
  const ProposedRing alone = ring_of(slope + ball), passed = ring_of(slope + ball + "velocity = [0.1, 0, 0]\n");
  EXPECT_EQ(passed.until, alone.until);
  EXPECT_GT(alone.until, 50);
  EXPECT_EQ(alone.fps, 1);
  EXPECT_EQ(passed.fps, 5);
  const std::string hold = "[[hold]]\nregion = \"x_min\"\nuntil = ";
  EXPECT_EQ(ring_of(slope + hold + "2\n").fps, 5);
  EXPECT_EQ(ring_of(slope + hold + "20\n").fps, 1);    // twenty frames
  EXPECT_EQ(ring_of(slope + hold + "0.001\n").fps, 5); // not more than 250 frames or so
}

// A layer on a steep wall for which ten times what a blade takes is nothing.
TEST(ProposedRing, TellsOfWhatFewFramesShow) {
  const auto warning = [](const std::string& blade, const RingWishes& wishes = {}) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.02\nthickness = 0.004\n"
        "center = [0, 0, 0.002]\n[material]\nviscosity = 20\ndensity = 500\n[environment]\ngravity = [0, -9.81, 0]\n"
        "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncontact = \"flow\"\n"
        "[[solid]]\nshape = \"box\"\nsize = [0.25, 0.006, 0.02]\ncenter = [0, 0.17, 0.012]\n" +
            blade,
        "s");
    return few_frames_warning(scene, first_frame(scene), wishes);
  };
  const std::string moves = "velocity = [0, -0.2, 0]\n", lets_go = "[[hold]]\nregion = \"y_max\"\nuntil = 1.6\n";
  EXPECT_THAT(warning(lets_go), testing::HasSubstr("has come through or ended by 1.6 s, which 4 of the frames show"));
  EXPECT_THAT(warning(lets_go), testing::EndsWith("--until 2.4 --fps 24 shows it"));
  EXPECT_EQ(warning(moves), "the run ends at 2.5 s, soon after what moves has come through: the sheet flows on, and "
                            "--until 190 shows that");
  EXPECT_EQ(warning(moves, {Quality::normal, 190, {}}).substr(0, 27), "what moves has come through");
  EXPECT_EQ(warning(""), "");
  EXPECT_EQ(warning(moves, {Quality::normal, {}, 2}), "");
  EXPECT_EQ(warning(moves, {Quality::normal, 2, {}}), "");
  EXPECT_EQ(warning("velocity = [[0, 0, 0, 0], [0.1, 0, 0, 0.2]]\n"), ""); // which is away for ever
}

// A compound of 20 mm and 100 mm square on level ground, driven by rho g h²/L = 56 Pa: U = h (tau - tau_y)² (2 tau +
// tau_y)/(6 mu tau²) = 9.80 mm/s, by Bingham's law, takes 10.2 s for 100 mm; free fall over that takes 0.1 s.
TEST(ProposedRing, GoesOnUntilWhatLiesHasGoneByItsLength) {
  const auto until = [](const std::string& yield_stress, const std::string& ground, const std::string& more = "") {
    return ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.1]\nedge_length = 0.02\nthickness = 0.02\n"
                   "center = [0, 0.01, 0]\n[material]\nlaw = \"bingham\"\nviscosity = 30\ndensity = 1400\n"
                   "yield_stress = " +
                   yield_stress +
                   "\n[environment]\ngravity = [0, -10, 0]\n[[solid]]\nshape = \"box\"\nsize = [1, 0.1, 1]\n"
                   "center = [0, -0.05, 0]\n" +
                   ground + more)
        .until;
  };
  EXPECT_EQ(until("8", "contact = \"flow\"\n"), 11);
  EXPECT_LT(until("60", "contact = \"flow\"\n"), 1); // it stands
  EXPECT_LT(until("8", ""), 1);                      // it sticks
  const std::string tool = "[[solid]]\nshape = \"sphere\"\nradius = 0.02\ncenter = [0, 0.1, 0]\n";
  EXPECT_EQ(until("8", "contact = \"flow\"\n", tool), 11);
  EXPECT_LT(until("8", "contact = \"flow\"\n", tool + "velocity = [0, 1, 0]\n"), 5); // what moves is to be seen
}

// A curtain that folds where it lands, with edges of as many digits as the mean of a mesh's has.
TEST(ProposedRing, LeavesRemeshingRoomWhateverTheEdges) {
  const std::string stages =
      ring_of("[sheet]\nshape = \"rectangle\"\nsize = [0.4, 0.2]\nplane = \"xy\"\nedge_length = 0.030925\n"
              "thickness = 0.003\ncenter = [0, 0.2, 0]\n[material]\nviscosity = 100\ndensity = 1000\n"
              "[environment]\ngravity = [0, -9.81, 0]\n[[inflow]]\nregion = \"y_max\"\nvelocity = [0, -0.1, 0]\n"
              "[[solid]]\nshape = \"plane\"\n[contact]\n")
          .stages;
  EXPECT_THAT(stages, testing::HasSubstr(" --min-edge 0.01545 --max-edge 0.0309 ")); // 0.0155 would leave none
}

} // namespace
} // namespace sheet
