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

Scene blown(const std::string& shape, const std::string& law) {
  return scene::parse_scene("[sheet]\n" + shape +
                                "radius = 0.1\nedge_length = 0.05\nthickness = 0.01\n[material]\ndensity = 1000\n" +
                                law + "[environment]\npressure = {law = \"constant\", value = 100}\n",
                            "s");
}

const std::string spherical = "shape = \"sphere\"\n", tubular = "shape = \"tube\"\nheight = 0.2\n";

// Of a power law the integral of c/rate over ln r is c (n/k) (K/tau)^(1/n).
TEST(BlowUp, OfAPowerLawByTheClosedForm) {
  const std::string power = "law = \"power\"\nviscosity = 400\nflow_index = 0.5\n";
  const double tension = 100 * 0.1 / 0.01, c = 2 * std::numbers::sqrt3;
  const double of_sphere = c * 0.5 / 3 * std::pow(400 * c / tension, 2), of_tube = 0.5 * std::pow(400 * 2 / tension, 2);
  EXPECT_NEAR(*blow_up_time(blown(spherical, power)), of_sphere, 5e-3 * of_sphere);
  EXPECT_NEAR(*blow_up_time(blown(tubular, power)), of_tube, 5e-3 * of_tube);
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

} // namespace
} // namespace sheet
