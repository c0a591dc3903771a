// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/view/liquid_looks.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/render/display.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::view {
namespace {

TEST(ColourOnWhite, OfAClearSlabIsBeersLawBothWays) {
  const double n = 1.5, face = std::pow((n - 1) / (n + 1), 2), h = 0.004;
  const render::Liquid liquid{static_cast<float>(n), {0, 100, 300}, render::Colour::Zero()};
  const DisplayedColour colour = colour_on_white(liquid, h);
  for (std::size_t c = 0; c < 3; ++c) {
    const double tau = std::exp(-h * static_cast<double>(liquid.absorption[static_cast<Eigen::Index>(c)]));
    const double through = (1 - face) * (1 - face) * tau / (1 - face * face * tau * tau);
    const double mirrored = face + face * tau * through;
    const double expected = through * through * 0.8 / (1 - 0.8 * mirrored);
    EXPECT_NEAR(colour[c], render::encode_srgb(static_cast<float>(expected)), 1e-5);
  }
}

TEST(ColourOnWhite, OfAThickTurbidSlabIsItsOwn) {
  const render::Liquid chocolate = render::preset(0);
  const DisplayedColour thick = colour_on_white(chocolate, 0.02), thin = colour_on_white(chocolate, 1e-6);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(thick[c], colour_on_white(chocolate, 0.04)[c], 1e-4);
    EXPECT_GT(thin[c], 0.85F); // the white below it
  }
  EXPECT_GT(thick[0], 1.2F * thick[1]); // brown
  EXPECT_GT(thick[1], 1.2F * thick[2]);
  EXPECT_LT(thick[0], 0.5F);
}

TEST(LiquidThickness, IsVolumeOverAreaOfEach) {
  const std::vector<Eigen::Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Corners> corners = {{0, 1, 2}, {1, 3, 2}, {0, 1, 3}};
  const formats::Frame frame = make_frame(x, corners, std::vector<double>{0.01, 0.03, 0.1});
  const std::vector<std::uint32_t> numbers = {0, 0, 2};
  const std::vector<double> each = liquid_thickness(frame, numbers, 3), all = liquid_thickness(frame, {}, 1);
  EXPECT_DOUBLE_EQ(each[0], 0.04);
  EXPECT_EQ(each[1], 0);
  EXPECT_DOUBLE_EQ(each[2], 0.2);
  EXPECT_NEAR(all.at(0), 0.14 / 1.5, 1e-15);
}

TEST(NamesOfLiquids, AreThoseOfTheirSheets) {
  const auto table = [](const char* name, double viscosity) {
    return fmt::format("[[sheet]]\n{}shape = \"disk\"\nradius = 1\nedge_length = 0.2\nthickness = 0.01\n"
                       "[sheet.material]\ndensity = 1000\nviscosity = {}\n",
                       name, viscosity);
  };
  const Scene scene = parse_scene(table("name = \"a\"\n", 1) + table("", 2) + table("name = \"b\"\n", 1), "scene");
  EXPECT_EQ(names_of_liquids(scene), (std::vector<std::string>{"a, b", "liquid 2"}));
}

} // namespace
} // namespace sheet::view
