// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/first_frame.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

// A second ago the plate was below the sheet.
TEST(FirstFrame, KnowsNothingOfWhereSolidsHaveBeen) {
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.2]\nedge_length = 0.02\n"
                                         "thickness = 0.005\n[material]\nviscosity = 50\ndensity = 1200\n"
                                         "[[hold]]\nregion = \"rim\"\nkind = \"pinned\"\n"
                                         "[[solid]]\nshape = \"box\"\nsize = [0.3, 0.01, 0.3]\ncenter = [0, 0.1, 0]\n"
                                         "velocity = [0, 0.2, 0]\n[contact]\nself = true\n",
                                         "s");
  testing::internal::CaptureStderr();
  const formats::Frame frame = checked_first_frame(scene);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// The part of a sheet of 4 mm that touches a solid from the start, with its middle so far from it [mm].
double touching(double distance, const std::string& solid, const std::string& gravity = "0, -9.81, 0") {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.05\n"
                  "thickness = 0.004\ncenter = [0, 0, {}]\n[material]\nviscosity = 20\ndensity = 1000\n"
                  "[environment]\ngravity = [{}]\n[[solid]]\nshape = \"plane\"\n{}",
                  distance / 1000, gravity, solid),
      "s");
  const formats::Frame frame = first_frame(scene);
  const auto touch = masks(frame, "touch");
  return static_cast<double>(std::ranges::count_if(touch, [](std::uint64_t bits) { return bits != 0; })) /
         static_cast<double>(frame.vertices);
}

// It falls on it as a whole.
TEST(FirstFrame, ACapCloselyAboveABallDoesNotTouchItAtItsRimAlone) {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"cap\"\nradius = 0.032\nangle = \"90 deg\"\nedge_length = 0.004\nthickness = 0.003\n"
      "[material]\nviscosity = 5\ndensity = 1250\n[environment]\ngravity = [0, -9.81, 0]\n"
      "[[solid]]\nshape = \"sphere\"\nradius = 0.03\ncontact = \"flow\"\n",
      "s");
  EXPECT_TRUE(masks(first_frame(scene), "touch").empty());
}

TEST(FirstFrame, WhatLiesCloselyBesideAnUprightWallTouchesIt) {
  const std::string wall = "normal = [0, 0, 1]\ncontact = \"flow\"\n";
  EXPECT_EQ(touching(2, wall), 1);
  EXPECT_EQ(touching(2.1, wall), 1);
  EXPECT_EQ(touching(2.9, wall), 1);
  EXPECT_EQ(touching(3.1, wall), 0);
  EXPECT_EQ(touching(2.1, "normal = [0, 0, 1]\n"), 0); // what sticks would stick at once
  EXPECT_EQ(touching(2.1, wall + "angular_velocity = [0, 0, 1]\n"), 1);
  EXPECT_EQ(touching(2.1, wall + "velocity = [0, 0, 0.01]\n"), 0);
  EXPECT_EQ(touching(2.1, wall, "0, -9.4, -2.8"), 0); // its weight presses it on
  EXPECT_EQ(touching(2.1, "normal = [1, 0, 0]\ncenter = [-0.1021, 0, 0]\ncontact = \"flow\"\n"), 0); // by its rim
}

// Of a coat of paint, thick in a band, at half the band's thickness from the wall.
TEST(FirstFrame, AFlatSheetAlongAWallTouchesItWhereItIsThin) {
  const auto part = [](double distance) {
    const Scene scene = scene::parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.02\n"
                    "thickness = {{along = \"y\", rows = [[0, 0.001], [0.05, 0.004], [0.1, 0.004], [0.15, 0.001]]}}\n"
                    "center = [0, 0, {}]\n[material]\nviscosity = 20\ndensity = 1000\n[environment]\n"
                    "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncontact = \"flow\"\n",
                    distance),
        "s");
    const formats::Frame frame = first_frame(scene);
    return static_cast<double>(std::ranges::count(masks(frame, "touch"), 1U)) / static_cast<double>(frame.vertices);
  };
  EXPECT_EQ(part(0.0018), 1);
  EXPECT_EQ(part(0.0031), 0);
}

// On a wall, below a ceiling, and around a rod; but not what lies on top, which comes to stick by its weight, nor what
// another solid carries.
TEST(FirstFrame, WhatStartsBesideOrBelowASolidToWhichItSticksIsStuck) {
  const std::string plane = "normal = [0, 0, 1]\n";
  EXPECT_EQ(touching(2, plane), 1);
  EXPECT_EQ(touching(2, plane, "0, 0, 9.81"), 1);
  EXPECT_EQ(touching(2, plane, "0, 0, -9.81"), 0);
  EXPECT_EQ(touching(2, plane + "[[hold]]\nregion = {box = [[-1, -1, -1], [1, 1, 1]]}\n"), 0); // as in a clamp
  EXPECT_EQ(
      touching(2, plane + "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, -1]\ncenter = [0, 0, 0.004]\n", "0, 0, 9.81"),
      0);
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"tube\"\nradius = 0.31\nheight = 0.2\nplane = \"xy\"\nedge_length = 0.03\n"
      "thickness = 0.02\n[material]\nviscosity = 30\ndensity = 1700\n[environment]\ngravity = [0, -9.81, 0]\n"
      "[[solid]]\nshape = \"cylinder\"\nradius = 0.3\nheight = 0.3\n"
      "rotation = {axis = [1, 0, 0], angle = \"90 deg\"}\nangular_velocity = [0, 0, 1]\n",
      "s");
  const formats::Frame frame = first_frame(scene);
  const auto touch = masks(frame, "touch");
  ASSERT_FALSE(touch.empty());
  for (std::size_t v = 0; v < frame.vertices; ++v)
    EXPECT_EQ(touch[v] != 0, positions(frame)[v].y() < 0.1 * positions(frame)[v].head<2>().norm()) << v;
}

// Under gravity tilted by 70 degrees a sheet lies in the plane most nearly across it, which is not along the slope.
TEST(FirstFrame, TellsOfASheetThatLiesEdgeOnToItsSlope) {
  const auto fault = [](const std::string& of_sheet, const std::string& gravity) -> std::string {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.1, 0.06]\nedge_length = 0.01\nthickness = 0.001\n"
        "center = [0, 0.0006, 0]\n" +
            of_sheet + "[material]\nviscosity = 10\ndensity = 2500\n[environment]\ngravity = " + gravity +
            "\n[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\n",
        "s");
    try {
      (void)checked_first_frame(scene);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(
      fault("", "[9.22, -3.36, 0]"),
      testing::HasSubstr("(the sheet lies in yz, as that is most nearly across gravity, which is along no axis: "
                         "plane = \"xz\" in [sheet] lays it along that solid)"));
  EXPECT_EQ(fault("plane = \"xz\"\n", "[9.22, -3.36, 0]"), "");
  EXPECT_EQ(fault("", "[3.36, -9.22, 0]"), "");
  EXPECT_THAT(fault("plane = \"xy\"\n", "[9.22, -3.36, 0]"),
              testing::AllOf(testing::HasSubstr("starts inside"), testing::Not(testing::HasSubstr("most nearly"))));
}

// A layer under a ceiling, level or leaning; but not where its weight presses it on, nor what lies on a board below.
TEST(FirstFrame, WhatHangsCloselyBelowASolidTouchesIt) {
  const std::string ceiling = "normal = [0, 0, 1]\ncontact = \"flow\"\n", down = "0, 0, 9.81";
  EXPECT_EQ(touching(2.9, ceiling, down), 1);
  EXPECT_EQ(touching(2.9, ceiling, "0, -5, 8"), 1);
  EXPECT_EQ(touching(3.1, ceiling, down), 0);
  EXPECT_EQ(touching(2.9, "normal = [0, 0, 1]\n", down), 0);
  EXPECT_EQ(touching(2.9, ceiling + "velocity = [0, 0, -0.01]\n", down), 0);
  EXPECT_EQ(touching(2.9, ceiling, "0, 0, -9.81"), 0);
  const auto on_a_board = [&](const std::string& gravity) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.05\nthickness = 0.004\n"
        "[material]\nviscosity = 20\ndensity = 1000\n[environment]\ngravity = [" +
            gravity +
            "]\n[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -0.0021]\ncontact = \"flow\"\n"
            "[[solid]]\nshape = \"box\"\nsize = [1, 1, 0.1]\ncenter = [0, 0, 0.0520]\ncontact = \"flow\"\n",
        "s");
    const formats::Frame frame = first_frame(scene);
    return masks(frame, "touch").front();
  };
  EXPECT_EQ(on_a_board(down), 2U); // only the box, on which it lies
  EXPECT_EQ(on_a_board("0, 0, -9.81"), 2U);
}

// A curtain that hangs in front of a plane from 1 s on, and flows in at its upper side.
TEST(FirstFrame, WhatFallsAtOnceTouchesTheSolidThatItIsCloselyAbove) {
  const std::string tray = "normal = [0, 0, 1]\ncontact = \"flow\"\n", creeping = "[model]\ninertia = false\n",
                    down = "0, -2, -9.6", held = "[[hold]]\nregion = \"y_max\"\n";
  EXPECT_EQ(touching(2.9, tray + creeping, down), 1);
  EXPECT_EQ(touching(3.1, tray + creeping, down), 0);
  EXPECT_EQ(touching(2.9, tray + "velocity = [0.1, 0, 0]\n" + creeping, down), 1);
  EXPECT_EQ(touching(2.9, tray, down), 0);                                                 // inertia lets it fall
  EXPECT_EQ(touching(2.9, tray + creeping + held, down), 0);                               // its hold carries it
  EXPECT_EQ(touching(2.9, tray + "velocity = [0.1, 0, 0]\n" + creeping, "0, -2, 9.6"), 0); // falls off it
}

TEST(FirstFrame, TellsOfOutflowsThatTakeAllAway) {
  const auto fault = [](const std::string& outflow, const std::string& more = "") -> std::string {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.04, 0.06]\nedge_length = 0.01\nthickness = 0.004\n[material]\n"
        "viscosity = 20\ndensity = 1300\n" +
            more + "[[outflow]]\npoint = [9, 0, 0]\nnormal = [1, 0, 0]\n[[outflow]]\n" + outflow,
        "s");
    try {
      (void)checked_first_frame(scene);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const std::string inflow = "[inflow]\nregion = \"x_min\"\nvelocity = [0.05, 0, 0]\n";
  const std::string right = "point = [0.2, 0, 0]\nnormal = [1, 0, 0]\n",
                    wrong = "point = [0.2, 0, 0]\nnormal = [-1, 0, 0]\n";
  EXPECT_EQ(fault(right), "");
  EXPECT_EQ(fault(right, inflow), "");
  EXPECT_EQ(fault("point = [0, 0, 0]\nnormal = [1, 0, 0]\n", inflow), ""); // half of the sheet, but not the inlet
  EXPECT_EQ(fault(wrong), "[[outflow]] 1 (from 0) takes the whole sheet away at the start: what is beyond its plane, "
                          "where its normal (-1, 0, 0) points, leaves; turn the normal round, or move its point");
  EXPECT_EQ(fault(wrong, inflow), fault(wrong));
  EXPECT_THAT(fault("point = [0, 0, 0]\nnormal = [-1, 0, 0]\n", inflow),
              testing::StartsWith("[[outflow]] 1 (from 0) takes the inlet away at the start: "));
}

TEST(FirstFrame, TellsAtOnceOfWhatWouldEndARunWhenASheetEnters) {
  const auto why_not = [](double height, double velocity) -> std::string {
    const Scene scene = scene::parse_scene(
        fmt::format("[[sheet]]\nname = \"plate\"\nshape = \"disk\"\nradius = 0.1\nedge_length = 0.05\n"
                    "thickness = 0.005\ncenter = [0, 0.1, 0]\n[[sheet]]\nname = \"curtain\"\nenters = 1\n"
                    "shape = \"rectangle\"\nplane = \"xy\"\nsize = [0.2, 0.2]\nedge_length = 0.05\n"
                    "thickness = 0.005\ncenter = [1, {}, 0]\n[material]\nviscosity = 50\ndensity = 1200\n"
                    "[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\n"
                    "[[inflow]]\nsheet = \"curtain\"\nregion = \"y_max\"\nvelocity = [0, {}, 0]\n",
                    height, velocity),
        "s");
    try {
      (void)checked_first_frame(scene);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why_not(0.15, -0.1), "");
  EXPECT_THAT(why_not(0.15, 0.1), testing::HasSubstr("the inflow's velocity at 1 s, (0, 0.1, 0) m/s, points out"));
  EXPECT_THAT(why_not(0.05, -0.1), testing::HasSubstr("the sheet starts inside solid 0 (plane)"));
}

} // namespace
} // namespace sheet
