// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that theory knows: the white furnace, and light through an absorbing slab.
#include "libsheet/render/path_tracer.h"

#include <cmath>
#include <numbers>

#include <optional>

#include <gtest/gtest.h>

#include "libsheet/base/parallel.h"
#include "libsheet/render/display.h"
#include "libsheet/render/draw.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

struct Furnace {
  formats::Frame frame;
  std::vector<SolidMesh> solids;
  double thinnest = 1e-4;
  std::optional<float> coat = {}; // roughness of the solids' coat
};

Picture draw_furnace(const Furnace& f, const Liquid& liquid, int pixels, int samples, double elevation = 25) {
  Box box = test::box_of(f.frame);
  const std::vector<Eigen::Isometry3d> motions(f.solids.size(), Eigen::Isometry3d::Identity());
  for (const SolidMesh& solid : f.solids)
    for (const Vector3& p : solid.positions)
      box.add(p);
  const World world(make_surface(middle_of(f.frame), f.thinnest), f.solids, motions, {}, box);
  const Lighting lighting = Lighting::uniform(1);
  Surroundings around;
  around.solids.assign(4, Colour::Ones());
  around.solid_gloss = f.coat;
  const PathTracer tracer(world, lighting, {liquid}, around);
  CameraOptions options;
  options.elevation = elevation;
  const Camera camera = test::frame_box(box, options, Vector3::UnitY(), 1, 0.05);
  DrawOptions draw_options;
  draw_options.width = draw_options.height = pixels;
  draw_options.samples = samples;
  return draw(
      world, camera,
      [&](const Ray& ray, Sampler& sampler, std::uint64_t& rays) { return tracer.radiance(ray, sampler, rays).sum(); },
      draw_options, nullptr);
}

// Means of blocks of 8 x 8 pixels are 1 within 1 %.
void expect_uniform(const Picture& picture, const std::string& name) {
  constexpr int block = 8;
  double sum = 0;
  for (int y = 0; y + block <= picture.light.height; y += block)
    for (int x = 0; x + block <= picture.light.width; x += block) {
      Colour mean = Colour::Zero();
      for (int j = 0; j < block; ++j)
        for (int i = 0; i < block; ++i)
          mean += picture.light.at(x + i, y + j) / (block * block);
      for (const float c : mean)
        EXPECT_NEAR(c, 1, 0.01) << name << ", block at " << x << ", " << y;
    }
  for (const Colour& c : picture.light.pixels)
    sum += static_cast<double>(c.mean());
  EXPECT_NEAR(sum / static_cast<double>(picture.light.pixels.size()), 1, 0.002) << name;
}

SolidMesh matte_ball(double radius) {
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::Sphere{radius};
  return make_solids(scene)[0];
}

TEST(WhiteFurnace, EveryMaterialWithoutAbsorptionIsInvisible) {
  for (std::size_t i = 0; i < liquid_names().size(); ++i) {
    Liquid liquid = preset(i);
    liquid.absorption.setZero();
    expect_uniform(draw_furnace({test::ball(32, 0.02), {}}, liquid, 24, 256), liquid_names()[i] + " ball");
    expect_uniform(draw_furnace({test::trough(12, 0.02), {}}, liquid, 24, 256), liquid_names()[i] + " trough");
  }
}

TEST(WhiteFurnace, AlsoOnAMatteSolidAndAsAFilm) {
  for (const std::size_t i : {2, 3}) { // honey, batter
    Liquid liquid = preset(i);
    liquid.absorption.setZero();
    // The solid touches the inner side, then the mid-surface.
    for (const double radius : {0.489, 0.5})
      expect_uniform(draw_furnace({test::ball(64, 0.02), {matte_ball(radius)}}, liquid, 24, 1024), "coated ball");
    expect_uniform(draw_furnace({test::trough(12, 1e-6), {}}, liquid, 24, 256), "film");
  }
}

TEST(WhiteFurnace, AlsoRoughAndWithACoat) {
  Liquid liquid = preset(3);
  liquid.absorption.setZero();
  for (const float roughness : {0.15F, 0.5F, 1.0F}) {
    liquid.roughness = roughness;
    expect_uniform(draw_furnace({test::ball(32, 0.02), {}}, liquid, 24, 256), "rough ball");
    expect_uniform(draw_furnace({test::trough(12, 0.02), {}}, liquid, 24, 256), "rough trough");
    expect_uniform(draw_furnace({test::trough(12, 0.02), {matte_ball(0.3)}, 1e-4, roughness}, liquid, 24, 512), "coat");
  }
}

// A wall, as the camera sees it between two that reflect all light: next to none would come in.
TEST(WhiteFurnace, BetweenPlanes) {
  const formats::Frame frame = test::flat(2, 0.01);
  Scene scene;
  for (const double side : {-1.0, 1.0}) {
    scene::Solid& wall = scene.solids.emplace_back();
    wall.shape = scene::HalfSpace{{-side, 0, 0}};
    wall.center = {side, 0, 0};
  }
  const World world(make_surface(middle_of(frame), 1e-4), {}, {}, make_planes(scene, 0), test::box_of(frame));
  const Lighting lighting = Lighting::uniform(1);
  Surroundings around;
  around.solids.assign(2, Colour::Ones());
  Liquid liquid = preset(3);
  liquid.absorption.setZero();
  const PathTracer tracer(world, lighting, {liquid}, around);
  const Ray ray{world.to_world({0, 0.1, 0}), Vec(0.8F, 0.6F, 0)};
  EXPECT_TRUE(world.nearest(ray).plane);
  constexpr std::uint32_t samples = 1024;
  Colour mean = Colour::Zero();
  std::uint64_t rays = 0;
  for (std::uint32_t i = 0; i < samples; ++i) {
    Sampler sampler(0, i);
    mean += tracer.radiance(ray, sampler, rays).sum() / samples;
  }
  for (const float c : mean)
    EXPECT_NEAR(c, 1, 0.02);
}

TEST(BeerLambert, LightThroughAFlatSlab) {
  // Under even light what is seen of a clear slab is R + T; absorption 100 / m over 10 mm, straight and slanted.
  Liquid liquid{1.5F, {0, 100, 400}, Colour::Zero()};
  for (const double elevation : {90.0, 40.0}) {
    const Picture picture = draw_furnace({test::flat(4, 0.01), {}}, liquid, 31, 64, elevation);
    const Colour seen = picture.light.at(15, 15);
    const double mu = std::sin(elevation * std::numbers::pi / 180), inside = std::sqrt(1 - (1 - mu * mu) / 2.25);
    const Fresnel f = fresnel(static_cast<float>(mu), 1.5F);
    for (int c = 0; c < 3; ++c) {
      const double tau = std::exp(-0.01 * static_cast<double>(liquid.absorption[c]) / inside);
      double expected = 0;
      for (const float face : {f.perpendicular, f.parallel}) {
        const double r = static_cast<double>(face), t = (1 - r) * (1 - r) * tau / (1 - r * r * tau * tau);
        expected += 0.5 * (t + r + r * tau * t);
      }
      EXPECT_NEAR(seen[c], expected, 4e-3) << "elevation " << elevation << ", channel " << c;
    }
  }
}

TEST(Draw, TheSameBitsForAnyNumberOfThreads) {
  std::vector<Colour> first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const Picture picture = draw_furnace({test::trough(12, 0.03), {matte_ball(0.2)}}, preset(1), 40, 8);
    if (first.empty())
      first = picture.light.pixels;
    ASSERT_EQ(first.size(), picture.light.pixels.size());
    for (std::size_t i = 0; i < first.size(); ++i)
      ASSERT_TRUE((first[i] == picture.light.pixels[i]).all()) << threads << " threads, pixel " << i;
  }
}

TEST(Draw, NoiseIsWhatAnotherPictureDiffersBy) {
  // The noise that a picture states against its distance from one with 64 times the samples.
  const Furnace f{test::trough(12, 0.03), {matte_ball(0.2)}};
  const Picture rough = draw_furnace(f, preset(3), 48, 16), fine = draw_furnace(f, preset(3), 48, 1024);
  double squares = 0;
  for (std::size_t i = 0; i < rough.light.pixels.size(); ++i) {
    const auto level = [](const Colour& c) { return static_cast<double>(display_level(luminance(c))); };
    const double d = level(rough.light.pixels[i]) - level(fine.light.pixels[i]);
    squares += d * d;
  }
  const double distance = std::sqrt(squares / static_cast<double>(rough.light.pixels.size()));
  EXPECT_NEAR(static_cast<double>(rough.noise) / distance, 1, 0.35);
  EXPECT_LT(fine.noise, 0.3F * rough.noise);
}

} // namespace
} // namespace sheet::render
