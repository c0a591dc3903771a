// SPDX-License-Identifier: GPL-3.0-or-later
// What moves, and pictures of it; the rays of a lens.
#include "libsheet/render/motion.h"

#include <gtest/gtest.h>

#include "libsheet/render/camera_rays.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

// Turns about the z axis, 2 rad/s.
Vector3 turning(const Vector3& x) { return {-2 * x.y(), 2 * x.x(), 0}; }

formats::Frame turning_trough() {
  formats::Frame frame = test::trough(8, 0.02);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = turning(positions(frame)[v]);
  return frame;
}

struct Seen {
  formats::Frame frame = turning_trough();
  World world{make_surface(middle_of(frame), 1e-4), {}, {}, {}, test::box_of(frame)};
  Camera camera = test::frame_box(test::box_of(frame), {}, Vector3::UnitY(), 1, 0.05);
};

TEST(Motion, VelocitiesAreThoseOfTheSheetWhereItIsHit) {
  const Seen seen;
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const CameraRays rays(seen.world, seen.camera);
    const Hit hit = seen.world.nearest(rays.middle((i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20));
    if (!hit.anything())
      continue;
    ++hits;
    const Vec v = velocity_at(seen.frame, nullptr, seen.world, hit);
    // Half a thickness from the middle.
    EXPECT_LT((v.cast<double>() - turning(seen.world.from_world(hit.position))).norm(), 2 * 0.013);
  }
  EXPECT_GE(hits, 100);
}

TEST(Motion, GoesOnStraight) {
  const Seen seen;
  const formats::Frame later = moved(seen.frame, 0.1);
  for (std::size_t v = 0; v < later.vertices; ++v) {
    const Vector3& x = positions(seen.frame)[v];
    EXPECT_LT((positions(later)[v] - (x + 0.1 * turning(x))).norm(), 1e-12);
  }
  const double pixels = pixels_moved(seen.frame, nullptr, {}, 0.1, seen.camera, 100);
  EXPECT_GT(pixels, 3);
  EXPECT_NEAR(pixels_moved(seen.frame, nullptr, {}, 0.05, seen.camera, 100) / pixels, 0.5, 0.02);
  EXPECT_EQ(pixels_moved(test::trough(8, 0.02), nullptr, {}, 0.1, seen.camera, 100), 0);
}

TEST(Motion, PicturesMixEvenly) {
  Picture dark, bright;
  dark.light = bright.light = Image(2, 1);
  dark.light.pixels = {Colour::Constant(0.1F), Colour::Zero()};
  bright.light.pixels = {Colour::Constant(0.3F), Colour::Ones()};
  dark.noise = 3;
  bright.noise = 4;
  dark.samples = bright.samples = 8;
  const Picture mean = mean_of({dark, bright});
  EXPECT_FLOAT_EQ(mean.light.pixels[0][0], 0.2F);
  EXPECT_FLOAT_EQ(mean.light.pixels[1][2], 0.5F);
  EXPECT_FLOAT_EQ(mean.noise, 2.5F);
  EXPECT_EQ(mean.samples, 16);
}

TEST(CameraRays, ALensIsSharpInItsPlaneAlone) {
  Seen seen;
  const double focus = 0.8 * seen.camera.eye().norm(), radius = 0.05;
  seen.camera.set_lens({radius, focus});
  const CameraRays rays(seen.world, seen.camera);
  const auto unit = static_cast<float>(seen.world.unit());
  const auto at = [&](const Ray& ray, double depth) -> Vec { // in metres
    const float along =
        static_cast<float>(depth) / unit - (ray.origin - rays.middle(0, 0).origin).dot(seen.camera.axis());
    return unit * (ray.origin + along / ray.direction.dot(seen.camera.axis()) * ray.direction);
  };
  const Ray middle = rays.middle(0.3, 0.6);
  for (std::uint32_t i = 0; i < 64; ++i) {
    const Ray ray = rays.through(0.3, 0.6, Sampler(0, i).point());
    EXPECT_LT((at(ray, focus) - at(middle, focus)).norm(), 1e-5F);
    EXPECT_LT((at(ray, 2 * focus) - at(middle, 2 * focus)).norm(), 1.0001F * static_cast<float>(radius));
  }
  // By similar triangles, over what the picture's height is there.
  const double picture = 2 * focus * seen.camera.pixel_angle(1);
  EXPECT_NEAR(static_cast<double>(rays.blur(at(middle, 2 * focus) / unit)), radius / picture, 1e-4);
  EXPECT_NEAR(static_cast<double>(rays.blur(at(middle, focus) / unit)), 0, 1e-5);
  const auto place = rays.place(middle.origin + 2 * middle.direction);
  ASSERT_TRUE(place);
  EXPECT_LT((*place - Eigen::Vector2d(0.3, 0.6)).norm(), 1e-5);
}

} // namespace
} // namespace sheet::render
