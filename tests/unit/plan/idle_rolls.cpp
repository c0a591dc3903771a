// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/idle_rolls.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// Of a film 0.2 m long, and rolls at these places.
std::size_t idle_rolls(const std::string& first, const std::string& second) {
  const auto roll = [](const std::string& place) {
    return "[[hold]]\nregion = {box = [[" + place +
           ", -1, -1], [1, 1, 1]]}\nroll = true\n"
           "motion = {kind = \"translating\", velocity = [1, 0, 0]}\n";
  };
  const Scene scene = scene::parse_scene("[sheet]\nshape = \"rectangle\"\nplane = \"xz\"\nsize = [0.2, 0.1]\n"
                                         "center = [0.1, 0, 0]\nedge_length = 0.02\nthickness = 0.001\n"
                                         "[material]\nviscosity = 10\ndensity = 1000\n" +
                                             roll(first) + roll(second),
                                         "s");
  return idle_roll_warnings(scene, first_frame(scene)).size();
}

TEST(IdleRolls, AreThoseBesideTheSheet) {
  EXPECT_EQ(idle_rolls("0.19", "0.15"), 0u);
  EXPECT_EQ(idle_rolls("0.19", "0.21"), 1u);
  EXPECT_EQ(idle_rolls("0.25", "0.21"), 2u);
}

} // namespace
} // namespace sheet
