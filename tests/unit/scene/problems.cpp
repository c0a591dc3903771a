// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "libsheet/scene/problems.h"

#include <array>

#include <gtest/gtest.h>

#include "libsheet/base/edit_distance.h"
#include "scenes.h"

namespace sheet::scene {
namespace {

constexpr std::array<std::string_view, 4> known{"viscosity", "density", "until", "axes"};

TEST(Problems, NearestWord) {
  EXPECT_EQ(nearest_word("viscocity", known), "viscosity");
  EXPECT_EQ(nearest_word("Viscosity", known), "viscosity");
  EXPECT_EQ(nearest_word("viscostiy", known), "viscosity");
  EXPECT_EQ(nearest_word("desity", known), "density");
  EXPECT_EQ(nearest_word("untill", known), "until");
  EXPECT_EQ(nearest_word("axis", known), "axes");
  EXPECT_EQ(nearest_word("stiffness", known), "");
  EXPECT_EQ(nearest_word(std::string(100000, 'x'), known), "");
}

TEST(Problems, Suggestions) {
  EXPECT_EQ(suggestion("untill", known), "; did you mean \"until\"?");
  EXPECT_EQ(suggestion("colour", known), "; known: viscosity, density, until, axes");
  EXPECT_EQ(suggestion("colour", std::array<std::string_view, 3>{"sheet", "sheet", "solid"}), "; known: sheet, solid");
  EXPECT_EQ(suggestion("colour", {}), "");
}

TEST(Problems, ManyAreCutShort) {
  std::string text = disk + liquid;
  for (int i = 0; i < 150; ++i)
    text += fmt::format("x{} = 1\n", i);
  const std::string all = problem(text);
  EXPECT_TRUE(all.ends_with("\ns: 50 more problems")) << all;
}

} // namespace
} // namespace sheet::scene
