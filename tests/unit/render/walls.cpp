// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid on a wall is seen in the light, whichever way the wall faces.
#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/render/picture_file.h"
#include "libsheet/render/render_stage.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

using test::V;

TEST(Walls, FaceTheLight) {
  int number = 0;
  for (const V& normal : {V(1, 0, 0), V(-1, 0, 0), V(0, 0, 1), V(0, 0, -1)}) {
    const std::filesystem::path file = testing::TempDir() + fmt::format("wall{}.png", number++);
    const V aside = normal.cross(V::UnitY());
    formats::Frame frame = test::grid(
        4, 0.01, [&](double s, double t) -> V { return (s - 0.5) * aside + (t - 0.5) * V::UnitY() + 0.005 * normal; });
    frame.put_text(
        "scene", fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 0.25\nthickness = "
                             "0.01\n[material]\nviscosity = 1\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n"
                             "[[solid]]\nshape = \"plane\"\nnormal = [{}, {}, {}]\n",
                             normal.x(), normal.y(), normal.z()));
    RenderOptions options;
    options.output = file;
    options.draw.width = 48;
    options.draw.height = 32;
    options.draw.samples = 16;
    RenderStage stage(options);
    stage.survey(frame);
    (void)stage.draw(frame, 0, nullptr);
    stage.finish();
    const Image image = read_picture(file);
    // Above the sheet, whose sides are upright in the picture; the wall throws back 0.68 of the light.
    EXPECT_GT(image.at(24, 0)[0], 0.4F) << normal.transpose();
    int dark = 0; // pixels in the middle row that show the sheet
    for (int x = 0; x < image.width; ++x)
      dark += image.at(x, 16)[2] < 0.2F ? 1 : 0;
    EXPECT_GT(dark, 20) << normal.transpose();
  }
}

} // namespace
} // namespace sheet::render
