// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/slopes.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

struct Layer {
  static constexpr double g = 9.81, h = 0.004, density = 1400, viscosity = 10;
};

// A disk of 40 mm, a layer thick, at that place, above those solids.
Scene disk_above(const std::string& center, const std::string& solids, const std::string& more = "") {
  return scene::parse_scene(
      fmt::format("[sheet]\nshape = \"disk\"\nradius = 0.04\nedge_length = 0.01\nthickness = {}\ncenter = [{}]\n{}\n"
                  "[material]\nviscosity = {}\ndensity = {}\n[environment]\ngravity = [0, {}, 0]\n{}",
                  Layer::h, center, more, Layer::viscosity, Layer::density, -Layer::g, solids),
      "s");
}

// Speed of the layer along the steepest solid, as --check prints it.
double speed_of(const Scene& scene) {
  const auto all = scene::scales_of_sheets(scene, measured_on_solids(scene, first_frame(scene)));
  return scene::layer_scales_of(scene, all.front())->speed;
}

double layer_speed(double along) {
  return Layer::density * Layer::h * (along + Layer::g * Layer::h / 0.04) * Layer::h / (3 * Layer::viscosity);
}

const std::string box =
    "[[solid]]\nshape = \"box\"\nsize = [0.2, 0.1, 0.2]\ncenter = [0, -0.05, 0]\ncontact = \"flow\"\n";

TEST(Slopes, ALevelTopOfABoxIsLevel) {
  EXPECT_NEAR(speed_of(disk_above("0, 0.002, 0", box)), layer_speed(0), 1e-9); // lies
  EXPECT_NEAR(speed_of(disk_above("0, 0.05, 0", box)), layer_speed(0), 1e-9);  // falls
}

TEST(Slopes, ATiltedBoxHasItsTilt) {
  const std::string tilted = box + "rotation = {axis = [0, 0, 1], angle = \"30 deg\"}\n";
  EXPECT_NEAR(speed_of(disk_above("0, 0.05, 0", tilted)), layer_speed(Layer::g / 2), 1e-6);
}

// What flows in runs on: down a tilted box as steeply as that is, down a ball to its side.
TEST(Slopes, WhereLiquidFlowsInTheyAreThoseOfItsWaysDown) {
  const std::string inflow = "[inflow]\nregion = \"rim\"\nvelocity = [0, -0.1, 0]\n";
  EXPECT_NEAR(speed_of(disk_above("0, 0.002, 0", box + inflow)), layer_speed(0), 1e-9);
  const std::string tilted = box + "rotation = {axis = [0, 0, 1], angle = \"30 deg\"}\n";
  EXPECT_NEAR(speed_of(disk_above("0, 0.05, 0", tilted + inflow)), layer_speed(Layer::g / 2), 1e-6);
  const std::string ball = "[[solid]]\nshape = \"sphere\"\nradius = 0.08\ncenter = [0, -0.08, 0]\ncontact = \"flow\"\n";
  EXPECT_NEAR(speed_of(disk_above("0, 0.01, 0", ball + inflow)), layer_speed(Layer::g), 0.01 * layer_speed(Layer::g));
}

TEST(Slopes, ABallIsAsSteepAsUnderTheSheet) {
  const std::string ball = "[[solid]]\nshape = \"sphere\"\nradius = 0.08\ncenter = [0, -0.08, 0]\ncontact = \"flow\"\n";
  EXPECT_NEAR(speed_of(disk_above("0, 0.01, 0", ball)), layer_speed(Layer::g / 2), 0.03 * layer_speed(Layer::g / 2));
}

TEST(Slopes, OnTheSideOfABoxItIsSteep) {
  const std::string side = "rotation = {axis = [0, 0, 1], angle = \"90 deg\"}";
  EXPECT_NEAR(speed_of(disk_above("-0.102, -0.05, 0", box, side)), layer_speed(Layer::g), 1e-9);
}

TEST(Slopes, WhatHangsOverTheEdgeRunsDownTheSide) {
  EXPECT_NEAR(speed_of(disk_above("0.08, 0.002, 0", box)), layer_speed(Layer::g), 1e-9);
}

TEST(Slopes, WhatTurnsMayBecomeSteep) {
  EXPECT_NEAR(speed_of(disk_above("0, 0.002, 0", box + "angular_velocity = [0, 0, 1]\n")), layer_speed(Layer::g), 1e-9);
}

} // namespace
} // namespace sheet
