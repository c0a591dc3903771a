// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/landing.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"

namespace sheet {
namespace {

solid::Solids planes(const std::string& first, const std::string& second = "") {
  const std::string solid = "[[solid]]\nshape = \"plane\"\n";
  return solid::Solids(scene::parse_scene("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n"
                                          "[material]\nviscosity = 10\ndensity = 1000\n[environment]\n"
                                          "gravity = [0, -10, 0]\n" +
                                              solid + first + (second.empty() ? "" : solid + second),
                                          "s"));
}

const Vector3 down = -Vector3::UnitY();
const std::string upright = "normal = [1, 0, 0]\n", floor_below = "center = [0, -50, 0]\n";

TEST(Landing, OnASlopeIsWhereTheWayMeetsIt) {
  const auto landing = landing_below(planes("normal = [1, 1, 0]\n"), down, {0, 1, 0}, 1, 0);
  ASSERT_TRUE(landing);
  EXPECT_NEAR(landing->fall, 1, 1e-12);
}

TEST(Landing, PastAnUprightWallIsOnTheFloor) {
  const auto landing = landing_below(planes(upright, floor_below), down, {0.0011, 0, 0}, 1, 0);
  ASSERT_TRUE(landing);
  EXPECT_EQ(landing->solid, 1U);
  EXPECT_NEAR(landing->fall, 50, 1e-12);
  EXPECT_FALSE(landing_below(planes(upright), down, {0.0011, 0, 0}, 1, 0));
}

// In steps as long as the wall is away each of these ways takes 90,000: all of them would take hours.
TEST(Landing, BesideAnUprightWallIsFoundAtOnce) {
  const solid::Solids wall = planes(upright);
  int landed = 0;
  for (int i = 0; i < 1'000'000; ++i)
    landed += landing_below(wall, down, {0.0011, 0, 1e-6 * i}, 1, 0) ? 1 : 0;
  EXPECT_EQ(landed, 0);
}

} // namespace
} // namespace sheet
