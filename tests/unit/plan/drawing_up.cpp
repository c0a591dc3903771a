// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/drawing_up.h"

#include <string>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

// 5 mm of syrup on a plate, and a rod, by default of 3 mm radius, that begins 5 mm above it.
std::string drawing(const std::string& motion, const std::string& center = "[0, 0.013, 0]",
                    const std::string& radius = "0.003") {
  const Scene scene = scene::parse_scene(
      "[sheet]\nshape = \"disk\"\nradius = 0.04\nedge_length = 0.004\nthickness = 0.005\ncenter = [0, 0.0025, 0]\n"
      "[material]\ndensity = 1400\nviscosity = 10\n[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\n"
      "shape = \"plane\"\ncontact = \"flow\"\n[[solid]]\nshape = \"capsule\"\nlength = 0.02\nradius = " +
          radius + "\nrotation = {axis = [0, 0, 1], angle = \"90 deg\"}\ncenter = " + center + "\nmotion = " + motion +
          "\n",
      "s");
  return drawing_up_warning(scene, first_frame(scene), 2);
}

TEST(DrawingUp, OfAToolThatComesDownAndGoesUp) {
  const std::string dips =
      "{kind = \"translating\", velocity = [[0, 0, -0.02, 0], [0.3, 0, -0.02, 0], [0.31, 0, 0, 0], "
      "[0.5, 0, 0.05, 0]]}";
  EXPECT_TRUE(
      drawing(dips).starts_with("solid 1 (capsule) comes to what lies on solid 0 (plane) and rises from it, but "
                                "draws nothing up"));
  EXPECT_EQ(drawing(dips, "[0, 0.05, 0]"), ""); // it does not come so far
  EXPECT_EQ(drawing(dips, "[0.1, 0.013, 0]"), "");
  EXPECT_EQ(drawing("{kind = \"translating\", velocity = [[0, 0, -0.02, 0], [0.3, 0, -0.02, 0], [0.31, 0, 0, 0]]}"),
            "");
  EXPECT_EQ(drawing("{kind = \"rotating\", axis = [1, 0, 0], rate = 3}", "[0, 0.0085, 0]"), "");
}

TEST(DrawingUp, NotOfAPinThatRollsOn) {
  const std::string radius = "0.02", aside = "[0, 0.0225, -0.06]"; // 2.5 mm above the plate
  const auto rolls = [](const std::string& velocity) {
    return "{kind = \"rotating\", axis = [1, 0, 0], rate = 2.5, velocity = " + velocity + "}";
  };
  EXPECT_EQ(drawing(rolls("[0, 0, 0.05]"), aside, radius), "");
  EXPECT_NE(drawing(rolls("[[0, 0, 0, 0.05], [1, 0, 0, 0.05], [1.1, 0, 0.05, 0.05]]"), aside, radius), "");
}

} // namespace
} // namespace sheet
