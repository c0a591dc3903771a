// SPDX-License-Identifier: GPL-3.0-or-later
// The camera goes round what there is to see.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/render/picture_file.h"
#include "libsheet/render/render_stage.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

using test::V;

TEST(Turntable, ACameraTurnedByAQuarterSeesWhatItSawTurned) {
  const Camera camera({0, 1, 5}, {0, 0, 0}, V::UnitY(), 40, 1.5);
  const V pivot(0.3, 0, 0.2);
  const Camera turned = camera.turned(pivot, V::UnitY(), std::numbers::pi / 2);
  const auto turn = [&](const V& x) -> V { // from z to x
    const V d = x - pivot;
    return pivot + V(d.z(), d.y(), -d.x());
  };
  EXPECT_LT((turned.eye() - turn(camera.eye())).norm(), 1e-12);
  for (const V& x : {V(0.4, 0.3, 0), V(-1, -0.2, 1)}) {
    const auto before = camera.place(x - camera.eye()), after = turned.place(turn(x) - turned.eye());
    ASSERT_TRUE(before && after);
    EXPECT_LT((*before - *after).norm(), 1e-12);
  }
}

// Columns of a picture in which there is something, from the first to the last; rows likewise.
struct Part {
  int left, right, top, bottom;
};
Part part_with_sheet(const Image& image) {
  Part part{image.width, -1, image.height, -1};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if ((image.at(x, y) - image.at(0, 0)).abs().maxCoeff() > 0.02F) {
        part = {std::min(part.left, x), std::max(part.right, x), std::min(part.top, y), std::max(part.bottom, y)};
      }
  return part;
}

TEST(Turntable, AllIsInThePictureFromAllSides) {
  // A strip beside the origin, 2 m long and 0.3 m wide.
  const formats::Frame frame = test::grid(4, 0.01, [](double s, double t) { return V(2 * s, 0, 0.3 * (0.5 - t)); });
  const std::filesystem::path folder = testing::TempDir();
  RenderOptions options;
  options.output = folder / "turn%d.png";
  options.look.kind = Look::Kind::wireframe;
  options.draw.width = 90;
  options.draw.height = 60;
  options.draw.samples = 4;
  options.turntable = 8;
  RenderStage stage(options);
  stage.survey(frame);
  int widest = 0, narrowest = options.draw.width;
  for (int i = 0; i < options.turntable; ++i) {
    const PictureReport report = stage.draw(frame, 17, nullptr);
    EXPECT_EQ(report.file, folder / ("turn" + std::to_string(i) + ".png"));
    const Part part = part_with_sheet(read_picture(report.file));
    EXPECT_GT(part.left, 0) << i;
    EXPECT_LT(part.right, 89) << i;
    EXPECT_GT(part.top, 0) << i;
    EXPECT_LT(part.bottom, 59) << i;
    widest = std::max(widest, part.right - part.left);
    narrowest = std::min(narrowest, part.right - part.left);
  }
  EXPECT_GT(widest, 70);
  EXPECT_LT(narrowest, 40);
}

} // namespace
} // namespace sheet::render
