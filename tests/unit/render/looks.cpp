// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/looks.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/render/display.h"
#include "libsheet/render/scale_bar.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

TEST(FalseColours, GrowLighterAndStayApart) {
  float before = -1;
  for (int i = 0; i <= 100; ++i) {
    const Colour c = false_colour(static_cast<float>(i) / 100, amounts);
    const float light = luminance({decode_srgb(c[0]), decode_srgb(c[1]), decode_srgb(c[2])});
    EXPECT_GT(light, before);
    before = light;
  }
}

TEST(FalseColours, APictureTellsTheThicknessOfEachTriangle) {
  // A sheet whose thickness grows in steps, seen from above: the colour of each pixel belongs to the triangle there.
  formats::Frame frame = test::flat(4, 0.01);
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] *= 1 + static_cast<double>(t) / 31;
  const Box box = test::box_of(frame);
  const World world(make_surface(middle_of(frame), 1e-4), {}, {}, {}, box);
  const Field& field = field_named("thickness");
  const std::vector<double> values = values_of(frame, field);
  Scale scale = Scale::nothing();
  scale.add(values);
  EXPECT_NEAR(scale.low, 0.01, 1e-12);
  EXPECT_NEAR(scale.high, 0.02, 1e-12);
  const Camera camera(Vector3(0, 3, 0), Vector3::Zero(), Vector3::UnitY(), 20, 1);
  const Shader shader = field_shader(world, field, values, scale);
  const auto x = positions(frame);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const Vector3 middle = (x[c[0]] + x[c[1]] + x[c[2]]) / 3;
    Sampler sampler(0, 0);
    std::uint64_t rays = 0;
    const Vec eye = world.to_world(camera.eye());
    const Vec toward = (world.to_world(middle) - eye).normalized();
    const Colour seen = shader({eye, toward}, sampler, rays);
    const double h = volumes(frame)[t] / (0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm());
    const Colour full = false_colour(static_cast<float>((h - 0.01) / 0.01), field.palette);
    const float shade = 0.72F + 0.28F * std::abs(toward.y());
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(seen[k], decode_srgb(shade * full[k]), 2e-3) << "triangle " << t;
  }
}

TEST(Ruler, RoundValuesInFittingUnits) {
  const Ruler thickness = make_ruler({0.00133, 0.00271}, field_named("thickness"), 5);
  EXPECT_EQ(thickness.title, "thickness [mm]");
  ASSERT_EQ(thickness.ticks.size(), 3U);
  EXPECT_EQ(thickness.ticks[0].label, "1.5");
  EXPECT_EQ(thickness.ticks[1].label, "2.0");
  EXPECT_NEAR(thickness.ticks[0].place, 0.17 / 1.38, 1e-9);
  const Ruler curvature = make_ruler({-12, 12}, field_named("curvature"), 5);
  EXPECT_EQ(curvature.title, "mean curvature [1/m]");
  ASSERT_EQ(curvature.ticks.size(), 5U);
  EXPECT_EQ(curvature.ticks[2].label, "0");
  EXPECT_EQ(make_ruler({0, 3e-6}, field_named("speed"), 4).title, "speed [\xb5m/s]");
}

TEST(Scale, IsNeverWithoutWidth) {
  for (const Field& field : fields())
    for (const Scale& scale : {Scale{0, 0}, Scale{0.02, 0.02 * (1 + 1e-12)}, Scale::nothing()}) {
      const Scale wide = widened(scale, field);
      EXPECT_LT(wide.low, wide.high);
      EXPECT_FALSE(make_ruler(wide, field, 5).ticks.empty());
    }
}

TEST(Scale, OfASheetAtRestHasNoNegativeSpeeds) {
  const Scale wide = widened({0, 0}, field_named("speed"));
  EXPECT_EQ(wide.low, 0);
  EXPECT_EQ(wide.high, 1);
}

TEST(ScaleBar, StandsBesideTheSubject) {
  for (const auto& [w, h] : {std::pair{320, 180}, {640, 360}, {1280, 720}, {500, 900}}) {
    Bitmap bitmap(w, h);
    ASSERT_TRUE(has_room_for_scale(w, h));
    for (const Scale& scale :
         {Scale{0.001, 0.002}, Scale{-1.23e-3, 1e-3}, Scale{999, 1000}, Scale{-1.7e-9, 1.7e-9}, Scale{-3e7, 3e7}})
      for (const auto& [name, look] : looks())
        draw_scale(bitmap, scale, look, 1.234e-5);
    const std::vector<std::uint8_t> before = Bitmap(w, h).bytes;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const auto at = static_cast<std::size_t>(3 * (y * w + x));
        if (bitmap.bytes[at] != before[at]) {
          const bool at_right = x >= w * (1 - scale_width(w, h)), below = y >= h * (1 - clock_height(w, h));
          ASSERT_TRUE(at_right || below) << x << " " << y;
        }
      }
  }
  EXPECT_FALSE(has_room_for_scale(128, 72));
}

TEST(ScaleBar, IsDrawnIntoSmallPicturesWithoutHarm) {
  for (const auto& [w, h] : {std::pair{1, 1}, {30, 20}, {640, 360}}) {
    Bitmap bitmap(w, h);
    draw_scale(bitmap, {0.001, 0.002}, looks()[1].second, 0.25);
    EXPECT_EQ(bitmap.bytes.size(), static_cast<std::size_t>(3 * w * h));
  }
}

} // namespace
} // namespace sheet::render
