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

// Up by 9 mm, to 10 mm above the middle of 5 mm; by 4 mm it does not come clear.
TEST(DrawingUp, OfAToolThatComesJustClear) {
  const auto rises = [](const std::string& speed) {
    return drawing("{kind = \"translating\", velocity = [[0, 0, -0.02, 0], [0.3, 0, -0.02, 0], [0.31, 0, 0, 0], "
                   "[0.5, 0, " +
                   speed + ", 0], [0.7, 0, " + speed + ", 0], [0.71, 0, 0, 0]]}");
  };
  EXPECT_NE(rises("0.03"), "");
  EXPECT_EQ(rises("0.0133"), "");
}

TEST(DrawingUp, NotOfAPinThatRollsOn) {
  const std::string radius = "0.02", aside = "[0, 0.0225, -0.06]"; // 2.5 mm above the plate
  const auto rolls = [](const std::string& velocity) {
    return "{kind = \"rotating\", axis = [1, 0, 0], rate = 2.5, velocity = " + velocity + "}";
  };
  EXPECT_EQ(drawing(rolls("[0, 0, 0.05]"), aside, radius), "");
  EXPECT_NE(drawing(rolls("[[0, 0, 0, 0.05], [1, 0, 0, 0.05], [1.1, 0, 0.05, 0.05]]"), aside, radius), "");
}

// Sealant of 5 mm over a joint, and a round tool 2 mm above its boards that is drawn along it, or stays above.
TEST(DrawingAlong, OfAToolThatComesToWhatSpansAJoint) {
  const auto warning = [](const std::string& height, const std::string& gap, const std::string& more = "",
                          const std::string& way = "[0, 0, 0.05]") {
    const std::string board = "[[solid]]\nshape = \"box\"\nsize = [0.04, 0.01, 0.12]\ncontact = \"flow\"\ncenter = [";
    const Scene scene = scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.014, 0.08]\nedge_length = 0.0025\nthickness = 0.005\n"
        "center = [0, 0.003, 0]\n[material]\ndensity = 1000\nviscosity = 80\n[environment]\n"
        "gravity = [0, -10, 0]\n" +
            board + "-" + gap + ", -0.005, 0]\n" + board + gap +
            ", -0.005, 0]\n[[solid]]\nshape = \"sphere\"\nradius = 0.008\ncenter = [0, " + height +
            ", -0.06]\nvelocity = " + way + "\n" + more,
        "s");
    return drawing_along_warning(scene, first_frame(scene), 2);
  };
  EXPECT_EQ(
      warning("0.01", "0.024"),
      "solid 2 (sphere) comes from above to what spans a gap, and goes on: a sheet stays with the solid that it "
      "touched first, and is drawn out behind it without end. adhesion = \"25 Pa\" in [contact] lets it come off");
  EXPECT_EQ(warning("0.01", "0.02"), ""); // no gap
  EXPECT_EQ(warning("0.02", "0.024"), "");
  EXPECT_EQ(warning("0.01", "0.024", "[contact]\nadhesion = 20\n"), "");
  EXPECT_EQ(warning("0.01", "0.024", "", "[0, 0, 0.001]"), ""); // does not come so far
}

} // namespace
} // namespace sheet
