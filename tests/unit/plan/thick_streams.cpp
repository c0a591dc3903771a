// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/thick_streams.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// A ribbon of honey, 6 mm thick, that falls from 60 mm.
std::string pouring(const std::string& width, const std::string& more, const std::string& viscosity = "4") {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"rectangle\"\nplane = \"yz\"\nedge_length = 0.004\nthickness = 0.006\ncenter = [0, 0.06, 0]\n"
      "size = [0.02, " +
          width + "]\n[material]\ndensity = 1400\nviscosity = " + viscosity +
          "\n[environment]\ngravity = [0, -9.81, 0]\n[[inflow]]\nregion = \"y_max\"\nvelocity = [0, -0.15, 0]\n"
          "[contact]\nself = true\n[[solid]]\nshape = \"plane\"\n" +
          more,
      "s");
  return thick_stream_warning(scene, first_frame(scene), 1);
}

TEST(ThickStreams, OfHoneyThatFolds) {
  const std::string flows = "contact = \"flow\"\n";
  EXPECT_EQ(pouring("0.012", flows),
            "inflow 0, 0.012 m wide and 0.006 m thick, piles up on solid 0 (plane) in folds that its weight closes "
            "within 0.05 s, but layers stay layers: [merge] after = \"0.1 s\" makes them one");
  EXPECT_EQ(pouring("0.06", flows), ""); // a curtain
  EXPECT_EQ(pouring("0.012", flows + "[merge]\nafter = 0.1\n"), "");
  EXPECT_EQ(pouring("0.012", flows, "40"), "");
  EXPECT_EQ(pouring("0.012", ""), "");                                         // it sticks
  EXPECT_EQ(pouring("0.012", flows + "surface_velocity = [1.5, 0, 0]\n"), ""); // a fast belt
}

} // namespace
} // namespace sheet
