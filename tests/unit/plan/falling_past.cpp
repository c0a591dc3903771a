// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/falling_past.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of a disk 50 mm above a box, drawn with y up.
std::string warning(const std::string& gravity, const std::string& of_sheet = "", const std::string& tables = "") {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"disk\"\nradius = 0.04\nplane = \"xz\"\nedge_length = 0.01\nthickness = 0.004\n"
      "center = [0, 0.05, 0]\n" +
          of_sheet + "[material]\nviscosity = 10\ndensity = 1000\n[environment]\ngravity = " + gravity +
          "\n[[solid]]\nshape = \"box\"\nsize = [0.2, 0.01, 0.2]\n" + tables,
      "s");
  return falling_past_warning(scene, first_frame(scene));
}

TEST(FallingPast, WhereGravityPointsAlongAnotherAxisOrUp) {
  EXPECT_EQ(warning("[0, -9.81, 0]"), "");
  EXPECT_EQ(warning("[0, 9.81, 0]"),
            "the sheet falls for ever, past every solid: none is below it, where gravity = [0, 9.81, 0] pulls");
  EXPECT_THAT(warning("[0, 0, -9.81]"), testing::HasSubstr("gravity = [0, 0, -9.81]"));
}

// On a box along which the liquid would flow, or to which it would stick, which the disk does not touch yet.
TEST(FallingPast, OfCreepingFlowThatTouchesNothing) {
  for (const std::string contact : {"flow", "stick"}) {
    const auto creeping = [&](const std::string& more) {
      return warning("[0, -9.81, 0]", "", "contact = \"" + contact + "\"\n[model]\ninertia = false\n" + more);
    };
    EXPECT_THAT(creeping(""), testing::HasSubstr("nothing resists the fall, there is no solution"));
    EXPECT_EQ(creeping("[[hold]]\nregion = \"rim\"\n"), "");
    EXPECT_EQ(creeping("[[solid]]\nshape = \"plane\"\ncenter = [0, 0.0485, 0]\n"), ""); // on which it lies
  }
  EXPECT_EQ(warning("[0, -9.81, 0]", "", "contact = \"flow\"\n"), "");
}

// Of a strip on a belt 0.4 m long, which ends 0.11 m ahead of it.
TEST(FallingOn, FromABeltsEndWhereNothingIsBelow) {
  const auto warning = [](double until, const std::string& more) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.08, 0.05]\nedge_length = 0.01\nthickness = 0.004\n"
        "center = [0.05, 0.002, 0]\n[material]\nviscosity = 100\ndensity = 1000\n[environment]\n"
        "gravity = [0, -9.81, 0]\n[[solid]]\nshape = \"box\"\nsize = [0.4, 0.02, 0.1]\n"
        "center = [0, -0.01, 0]\nsurface_velocity = [0.1, 0, 0]\n" +
            more,
        "s");
    return falling_on_warning(scene, first_frame(scene), until);
  };
  const std::string adhesion = "[contact]\nadhesion = 50\n";
  for (const std::string& contact : {std::string(), adhesion})
    EXPECT_THAT(warning(5, contact),
                testing::AllOf(testing::StartsWith("solid 0 (box) carries what lies on it past its end, from about 1"),
                               testing::HasSubstr("[[outflow]] point = [0, -0.0"),
                               testing::EndsWith("normal = [0, -1, 0] ends it")));
  EXPECT_EQ(warning(0.5, adhesion), "");
  EXPECT_EQ(warning(5, adhesion + "[[outflow]]\npoint = [0, -1, 0]\nnormal = [0, -1, 0]\n"), "");
  EXPECT_EQ(warning(5, adhesion + "[[solid]]\nshape = \"plane\"\ncenter = [0, -1, 0]\n"), "");
  const auto aside = [&](const std::string& x) { // it falls off before it gets to one that is farther off than the end
    return warning(5, adhesion + "[[outflow]]\npoint = [" + x + ", 0, 0]\nnormal = [1, 0, 0]\n");
  };
  EXPECT_NE(aside("0.5"), "");
  EXPECT_EQ(aside("0.15"), "");
  EXPECT_NE(warning(5, adhesion + "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -1]\n"), "");
  const std::string ball = adhesion + "[[solid]]\nshape = \"sphere\"\nradius = 0.02\n";
  EXPECT_EQ(warning(5, ball + "center = [0.3, -0.05, 0]\n"), "");
  EXPECT_NE(warning(5, ball + "center = [0.3, -0.02, 0]\n"), "");
}

TEST(FallingPast, NotOfWhatMayComeToASolidOtherwise) {
  const std::string up = "[0, 9.81, 0]";
  EXPECT_EQ(warning(up, "velocity = [1, 0, 0]\n"), "");
  EXPECT_NE(warning(up, "velocity = [0, -1, 0]\n"), "");
  EXPECT_EQ(warning(up, "angular_velocity = [0, 1, 0]\n"), "");
  EXPECT_EQ(warning(up, "", "velocity = [0, 1, 0]\n"), ""); // of the box
  EXPECT_EQ(warning(up, "", "[[hold]]\nregion = \"rim\"\n"), "");
  EXPECT_EQ(warning(up, "", "[[inflow]]\nregion = \"rim\"\nvelocity = [0, 0, 1]\n"), "");
  EXPECT_EQ(warning(up, "", "[[solid]]\nshape = \"plane\"\ncenter = [0, 1, 0]\n"), "");
  const std::string wall = "[[solid]]\nshape = \"plane\"\nnormal = [0, 1, 0]\ncenter = [0, 0.0";
  EXPECT_EQ(warning("[0, 0, -9.81]", "", wall + "48, 0]\n"), ""); // down a wall on which it lies
  EXPECT_NE(warning("[0, 0, -9.81]", "", wall + "40, 0]\n"), "");
}

// As near to the wall as its thick part is thick, and farther than its mean thickness.
TEST(FallingPast, NotOfASheetThatLiesOnAWallWhereItIsThick) {
  const auto of = [](const std::string& distance) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.2, 0.3]\nplane = \"xy\"\nedge_length = 0.02\n"
        "thickness = {along = \"y\", rows = [[0, 0.001], [0.05, 0.004], [0.07, 0.004], [0.1, 0.001]]}\n"
        "center = [0, 0, " +
            distance +
            "]\n[material]\nviscosity = 20\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n"
            "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncontact = \"flow\"\n",
        "s");
    return falling_past_warning(scene, first_frame(scene));
  };
  EXPECT_EQ(of("0.0019"), "");
  EXPECT_NE(of("0.0031"), "");
}

// A disk, a quarter of which is over the edge of a table.
TEST(FallingOn, OverAnEdgeFromTheStart) {
  const auto warning = [](const std::string& x, const std::string& liquid, const std::string& more = "") {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"disk\"\nradius = 0.08\nedge_length = 0.01\nthickness = 0.01\ncenter = [" + x +
            ", 0.006, 0]\n[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = \"box\"\n"
            "size = [0.4, 0.03, 0.4]\ncenter = [-0.2, -0.015, 0]\ncontact = \"flow\"\n" +
            more + "[material]\ndensity = 1100\n" + liquid,
        "s");
    return falling_on_warning(scene, first_frame(scene), 0.75);
  };
  const std::string thin = "viscosity = 1.5\n";
  EXPECT_THAT(warning("-0.04", thin), testing::AllOf(testing::HasSubstr("over the edge of solid 0 (box): its weight "),
                                                     testing::HasSubstr("[[outflow]] point = [")));
  EXPECT_EQ(warning("-0.2", thin), "");
  EXPECT_EQ(warning("-0.04", "viscosity = 1e4\n"), "");
  EXPECT_EQ(warning("-0.04", "viscosity = 1.5\nlaw = \"bingham\"\nyield_stress = 2000\n"), "");
  EXPECT_EQ(warning("-0.04", thin, "[[solid]]\nshape = \"plane\"\ncenter = [0, -1, 0]\n"), "");
}

// Of a film, 0.3 m long, whose roll ends 10 mm behind it.
TEST(FallingBehindRolls, WhereNothingTakesUpWhatTheyDraw) {
  const auto warning = [](const std::string& more, const std::string& roll = "roll = true\n") {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.3, 0.1]\nedge_length = 0.02\nthickness = 0.001\n[material]\n"
        "viscosity = 1e4\ndensity = 900\n[environment]\ngravity = [0, -9.81, 0]\n" +
            more + "[[hold]]\nregion = {box = [[0.1, -1, -1], [0.16, 1, 1]]}\n" + roll +
            "motion = {kind = \"translating\", velocity = [0.06, 0, 0]}\n",
        "s");
    return falling_behind_rolls_warning(scene, first_frame(scene));
  };
  EXPECT_THAT(warning(""), testing::AllOf(testing::StartsWith("hold 0, a roll, lets go of what it draws where nothing"),
                                          testing::HasSubstr("[[outflow]] point = [0.18, 0, "),
                                          testing::HasSubstr("normal = [1, 0, 0] ends it")));
  const auto outflow = [](const std::string& x, const std::string& normal) {
    return "[[outflow]]\npoint = [" + x + ", 0, 0]\nnormal = " + normal + "\n";
  };
  EXPECT_EQ(warning(outflow("0.18", "[1, 0, 0]")), "");
  EXPECT_NE(warning(outflow("0.3", "[1, 0, 0]")), ""); // it hangs down before it gets there
  EXPECT_EQ(warning(outflow("0.3", "[0, -1, 0]")), "");
  EXPECT_EQ(warning("bath = {density = 1000, level = -1}\n"), "");
  EXPECT_EQ(warning("[[solid]]\nshape = \"plane\"\ncenter = [0, -1, 0]\n"), "");
  EXPECT_EQ(warning("", ""), ""); // what it holds stays held
}

} // namespace
} // namespace sheet
