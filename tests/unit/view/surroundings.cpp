// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/surroundings.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"

namespace sheet::view {
namespace {

// A page draws a bath below what floats on it, and a sea at its level.
TEST(Surroundings, ABathThatAPlaneSlopesIntoIsASea) {
  const auto kind = [](const std::string& normal) {
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.01\n[material]\nviscosity = 10\n"
        "density = 1000\n[environment]\ngravity = [0, -10, 0]\nbath = {density = 1000, level = -1}\n[[solid]]\n"
        "shape = \"plane\"\ncenter = [0, -2, 0]\nnormal = " +
            normal + "\n",
        "s");
    return place_surroundings(scene, {}, 0).surfaces.back().kind;
  };
  EXPECT_EQ(kind("[0.3, 1, 0]"), "sea");
  EXPECT_EQ(kind("[0, 1, 0]"), "bath");
  EXPECT_EQ(kind("[1, 0, 0]"), "bath");
}

} // namespace
} // namespace sheet::view
