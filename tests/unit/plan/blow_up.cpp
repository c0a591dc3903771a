// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/blow_up.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

Scene blown(const std::string& shape, const std::string& law, const std::string& more = "") {
  return scene::parse_scene("[sheet]\n" + shape +
                                "radius = 0.1\nedge_length = 0.05\nthickness = 0.01\n[material]\ndensity = 1000\n" +
                                law + "[environment]\npressure = {law = \"constant\", value = 100}\n" + more,
                            "s");
}

const std::string spherical = "shape = \"sphere\"\n", tubular = "shape = \"tube\"\nheight = 0.2\n";

// Of a power law the integral of c/rate over ln r is c (n/k) (K/tau)^(1/n).
TEST(BlowUp, OfAPowerLawByTheClosedForm) {
  const std::string power = "law = \"power\"\nviscosity = 400\nflow_index = 0.5\n";
  const double tension = 100 * 0.1 / 0.01, c = 2 * std::numbers::sqrt3;
  const double of_sphere = c * 0.5 / 3 * std::pow(400 * c / tension, 2), of_tube = 0.5 * std::pow(400 * 2 / tension, 2);
  const std::string creeping = "[model]\ninertia = false\n";
  EXPECT_NEAR(*blow_up_time(blown(spherical, power, creeping)), of_sphere, 5e-3 * of_sphere);
  EXPECT_NEAR(*blow_up_time(blown(tubular, power, creeping)), of_tube, 5e-3 * of_tube);
}

// Surface tension: dr/dt = (p r - 4 gamma) r³/(12 mu h0 r0²), so 12 mu h0/(p r0) times the integral of 1/(u³(u - b))
// from 1, b = 4 gamma/(p r0), which is -ln(1 - b)/b³ - 1/b² - 1/(2 b). Inertia: thrown by its radius.
TEST(BlowUp, OfWhatTensionHoldsBack) {
  const auto tense = [](double gamma) { return "viscosity = 400\nsurface_tension = " + std::to_string(gamma) + "\n"; };
  const auto model = std::string("[model]\ninertia = false\n");
  const double b = 0.5, viscous = 12 * 400 * 0.01 / (100 * 0.1);
  const double creeping = viscous * (-std::log(1 - b) / (b * b * b) - 1 / (b * b) - 1 / (2 * b));
  const double thrown = std::sqrt(2 * 1000 * 0.01 * 0.1 / (100 * (1 - b)));
  EXPECT_NEAR(*blow_up_time(blown(spherical, tense(1.25), model)), creeping, 5e-3 * creeping);
  EXPECT_NEAR(*blow_up_time(blown(spherical, tense(1.25))), creeping + thrown, 5e-3 * creeping);
  EXPECT_NEAR(*blow_up_time(blown(spherical, tense(0), model)), viscous / 3, 5e-3 * viscous);
  EXPECT_FALSE(blow_up_time(blown(spherical, tense(2.51))));
  EXPECT_TRUE(blow_up_time(blown(tubular, tense(2.51))));
  EXPECT_FALSE(blow_up_time(blown(tubular, tense(5.01))));
  // one of 0.1 m and 30 degrees ends as a part of a sphere, where that is less than a half of one over its rim
  const std::string shallow = "shape = \"cap\"\nangle = \"30 deg\"\n", held = "[[hold]]\nregion = \"rim\"\n";
  EXPECT_FALSE(blow_up_time(blown(shallow, tense(1.3), held)));
  EXPECT_TRUE(blow_up_time(blown(shallow, tense(1.2), held)));
  EXPECT_TRUE(blow_up_time(blown(shallow, tense(1.3))));
}

TEST(BlowUp, NotOfWhatStands) {
  const auto bingham = [](double yield) {
    return "law = \"bingham\"\nviscosity = 400\nyield_stress = " + std::to_string(yield) + "\n";
  };
  const double stands = 100 * 0.1 / 0.01 / (2 * std::numbers::sqrt3);
  EXPECT_FALSE(blow_up_time(blown(spherical, bingham(1.01 * stands))));
  EXPECT_TRUE(blow_up_time(blown(spherical, bingham(0.99 * stands))));
  const double newtonian = *blow_up_time(blown(spherical, "viscosity = 400\n"));
  EXPECT_NEAR(*blow_up_time(blown(spherical, bingham(1e-6))), newtonian, 5e-3 * newtonian);
}

// A parison in a box of six planes, and above a floor.
TEST(BlowUp, NotOfWhatIsInAMould) {
  const auto proposed = [](const std::vector<std::string>& planes) {
    std::string text = "viscosity = 4000\n[environment]\npressure = {law = \"constant\", value = 1000}\n";
    for (const std::string& plane : planes)
      text += "[[solid]]\nshape = \"plane\"\n" + plane;
    const Scene scene = scene::parse_scene("[sheet]\nshape = \"tube\"\nheight = 0.2\nradius = 0.1\n"
                                           "edge_length = 0.05\nthickness = 0.01\n[material]\ndensity = 1000\n" +
                                               text,
                                           "s");
    const auto first = first_frame(scene);
    EXPECT_EQ(is_blown_into_mould(scene, first), planes.size() == 6);
    return proposed_ring(scene, first, {}).until;
  };
  const std::string floor = "center = [0, -0.2, 0]\nnormal = [0, 1, 0]\n";
  const double free = 2 * 4000 * 0.01 / (1000 * 0.1);
  EXPECT_LT(proposed({floor}), free);
  EXPECT_GT(proposed({floor, "center = [0, 0.2, 0]\nnormal = [0, -1, 0]\n",
                      "center = [0.2, 0, 0]\nnormal = [-1, 0, 0]\n", "center = [-0.2, 0, 0]\nnormal = [1, 0, 0]\n",
                      "center = [0, 0, 0.2]\nnormal = [0, 0, -1]\n", "center = [0, 0, -0.2]\nnormal = [0, 0, 1]\n"}),
            free);
}

// A square film of 0.3 m, held at its rim, under a fifth of a bar: 1.5 pi mu h/(p a) = 63 ms, and 5.5 ms as it is
// thrown. Over a floor it bulges to the sides, but not in a box.
TEST(BlowUp, OfAFlatSheetThatIsHeldAtItsRim) {
  const auto film = [](const std::string& hold, const std::string& more) {
    return scene::parse_scene(
        "[sheet]\nshape = \"rectangle\"\nsize = [0.3, 0.3]\nedge_length = 0.03\nthickness = 0.002\n"
        "[material]\ndensity = 1000\n" +
            more + "[environment]\npressure = {law = \"constant\", value = -2e4}\n" + hold,
        "s");
  };
  const std::string held = "[[hold]]\nregion = \"rim\"\n", liquid = "viscosity = 2e4\n";
  const double creeping = 1.5 * std::numbers::pi * 2e4 * 0.002 / (2e4 * 0.15),
               thrown = std::sqrt(2 * 1000 * 0.002 * 0.15 / 2e4);
  EXPECT_NEAR(*blow_up_time(film(held, liquid)), creeping + thrown, 1e-3 * creeping);
  // tau = K sqrt(rate): c (4 c h K/(2 p a))² times the integral of s³/(1 + s²)⁵, 1/24
  const double c = 2 * std::numbers::sqrt3, power = c * std::pow(2 * c * 0.002 * 5e4 / (2e4 * 0.15), 2) / 24;
  EXPECT_NEAR(*blow_up_time(film(held, "law = \"power\"\nviscosity = 5e4\nflow_index = 0.5\n")), power + thrown,
              1e-3 * power);
  EXPECT_FALSE(blow_up_time(film("", liquid)));
  EXPECT_FALSE(blow_up_time(film(held + "until = 1\n", liquid)));
  EXPECT_FALSE(blow_up_time(film(held, "law = \"bingham\"\nviscosity = 2e4\nyield_stress = 1e6\n")));
  const std::string floor = "[[solid]]\nshape = \"plane\"\ncenter = [0, -0.12, 0]\n";
  const Scene above = film(held + floor, liquid);
  EXPECT_FALSE(is_blown_into_mould(above, first_frame(above)));
  EXPECT_LT(proposed_ring(above, first_frame(above), {}).until, creeping + thrown);
  std::string walls;
  for (const std::string plane : {"[0.16, 0, 0]\nnormal = [-1, 0, 0]", "[-0.16, 0, 0]\nnormal = [1, 0, 0]",
                                  "[0, 0, 0.16]\nnormal = [0, 0, -1]", "[0, 0, -0.16]\nnormal = [0, 0, 1]"})
    walls += "[[solid]]\nshape = \"plane\"\ncenter = " + plane + "\n";
  const Scene mould = film(held + floor + walls, liquid);
  EXPECT_TRUE(is_blown_into_mould(mould, first_frame(mould)));
}

} // namespace
} // namespace sheet
