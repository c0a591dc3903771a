// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/wetting.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/read.h"

namespace sheet {
namespace {

using testing::HasSubstr;

// Honey 2 mm thick on a plate: a puddle of it stands 2 sqrt(0.06/(1400 9.81)) = 4.18 mm high where nothing is wetted.
std::string wetting(const std::string& plate, const std::string& material = "viscosity = 6\nsurface_tension = 0.06\n",
                    const std::string& more = "", double thickness = 0.002,
                    const std::string& gravity = "[0, -9.81, 0]") {
  const Scene scene = scene::parse_scene(
      fmt::format("[sheet]\nshape = \"disk\"\nradius = 0.02\nedge_length = 0.004\nthickness = {}\ncenter = [0, {}, 0]\n"
                  "[material]\ndensity = 1400\n{}[environment]\ngravity = {}\n{}[[solid]]\n"
                  "shape = \"plane\"\n{}",
                  thickness, thickness / 2, material, gravity, more, plate),
      "s");
  return wetting_warning(scene, first_frame(scene), 5);
}

TEST(Wetting, OfAThinLayerWithFreeRims) {
  const std::string flows = "contact = \"flow\"\n";
  const std::string warning = wetting(flows);
  EXPECT_THAT(warning, HasSubstr("nothing wets solid 0 (plane): tension keeps what flows there from spreading where"));
  EXPECT_THAT(
      wetting(flows + "normal = [0, 1, 0]\n", "viscosity = 6\nsurface_tension = 0.06\n", "", 0.002, "[6, -8, 0]"),
      HasSubstr("keeps what runs down there from spreading sideways where"));
  EXPECT_THAT(warning, HasSubstr("contact_angle = \"20 deg\""));
  EXPECT_THAT(warning, HasSubstr("of 57 deg")); // 2 asin(2/4.18)
  EXPECT_EQ(wetting(flows + "contact_angle = \"20 deg\"\n"), "");
  EXPECT_EQ(wetting("contact = \"stick\"\n"), "");
  EXPECT_EQ(wetting(flows, "viscosity = 6\n"), "");
  EXPECT_EQ(wetting(flows, "viscosity = 6\nsurface_tension = 0.06\n", "", 0.005), "");
  EXPECT_EQ(wetting(flows, "viscosity = 6e4\nsurface_tension = 0.06\n"), ""); // it hardly moves in 5 s
  EXPECT_EQ(wetting(flows, "law = \"bingham\"\nyield_stress = 100\nviscosity = 6\nsurface_tension = 0.06\n"), "");
  // At 2 gamma/h = 60 Pa it has 670 Pa s.
  EXPECT_NE(wetting(flows, "law = \"power\"\nflow_index = 0.5\nreference_rate = 1e-4\nviscosity = 2e4\n"
                           "surface_tension = 0.06\n"),
            "");
  EXPECT_EQ(wetting(flows, "viscosity = 6\nsurface_tension = 0.06\n", "[[hold]]\nregion = \"rim\"\n"), "");
}

} // namespace
} // namespace sheet
