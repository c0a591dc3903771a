// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/problems.h"

#include <array>

#include <gtest/gtest.h>

#include "scenes.h"

namespace sheet::scene {
namespace {

constexpr std::array<std::string_view, 4> known{"viscosity", "density", "until", "axes"};

TEST(Problems, NearestWord) {
  EXPECT_EQ(nearest("viscocity", known), "viscosity");
  EXPECT_EQ(nearest("Viscosity", known), "viscosity");
  EXPECT_EQ(nearest("viscostiy", known), "viscosity");
  EXPECT_EQ(nearest("desity", known), "density");
  EXPECT_EQ(nearest("untill", known), "until");
  EXPECT_EQ(nearest("axis", known), "axes");
  EXPECT_EQ(nearest("stiffness", known), "");
  EXPECT_EQ(nearest(std::string(100000, 'x'), known), "");
}

TEST(Problems, Suggestions) {
  EXPECT_EQ(suggestion("untill", known), "; did you mean \"until\"?");
  EXPECT_EQ(suggestion("colour", known), "; known: viscosity, density, until, axes");
  EXPECT_EQ(suggestion("colour", {}), "");
}

TEST(Problems, ManyAreCutShort) {
  std::string text = disk + liquid;
  for (int i = 0; i < 150; ++i)
    text += "x" + std::to_string(i) + " = 1\n";
  const std::string all = problem(text);
  EXPECT_TRUE(all.ends_with("\ns: 50 more problems")) << all;
}

} // namespace
} // namespace sheet::scene
