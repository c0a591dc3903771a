// SPDX-License-Identifier: GPL-3.0-or-later
// Smoothing, and pictures of few samples against those of many.
#include "libsheet/render/denoised.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/base/parallel.h"
#include "libsheet/render/display.h"
#include "libsheet/render/smooth.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

constexpr int width = 48, height = 32;

// Uniform noise of that amplitude around a level, different in both halves.
Halves noisy(std::uint32_t pixel, float level, float amplitude) {
  const auto half = [&](std::uint32_t sample) {
    return Colour::Constant(level + amplitude * (2 * Sampler(pixel, sample).number() - 1));
  };
  return {half(0), half(1)};
}

// A plane before the camera whose light is dark on the left and bright on the right; `way` tells of each column what it
// shows.
struct TwoSides {
  std::vector<SurfacePoint> points;
  std::vector<Halves> light;
  std::vector<int> samples = std::vector<int>(static_cast<std::size_t>(width * height), 2);

  explicit TwoSides(float amplitude, const std::function<std::uint32_t(int)>& way) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        points.push_back({Vec::UnitZ(), {static_cast<float>(x), static_cast<float>(y), 0}, 1, way(x)});
        light.push_back(noisy(static_cast<std::uint32_t>(light.size()), x < width / 2 ? 0.2F : 0.6F, amplitude));
      }
  }
  // Root mean square distance from what the light would be without noise, of the columns.
  [[nodiscard]] double error(int first, int end) const {
    double sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = first; x < end; ++x) {
        const double d =
            static_cast<double>(light[static_cast<std::size_t>(y * width + x)].mean()[0]) - (x < width / 2 ? 0.2 : 0.6);
        sum += d * d;
      }
    return std::sqrt(sum / (height * (end - first)));
  }
};

TEST(Smooth, TakesNoiseAwayAndKeepsEdgesBetweenSurfaces) {
  TwoSides sides(0.3F, [](int x) { return x < width / 2 ? 1U : 2U; });
  const double before = sides.error(0, width);
  smooth(sides.light, sides.points, sides.samples, width);
  EXPECT_LT(sides.error(0, width), before / 5);
  EXPECT_LT(sides.error(width / 2 - 1, width / 2 + 1), before / 4);
}

TEST(Smooth, KeepsAnEdgeOfTheLightThatStandsOutOfTheNoise) {
  TwoSides sides(0.05F, [](int) { return 1U; });
  const double before = sides.error(0, width);
  smooth(sides.light, sides.points, sides.samples, width);
  EXPECT_LT(sides.error(0, width), before / 2);
  EXPECT_LT(sides.error(width / 2 - 1, width / 2 + 1), before);
}

TEST(Smooth, LeavesLightAloneThatHasNoNoiseOrNoSurface) {
  TwoSides sure(0, [](int) { return 1U; }), nothing(0.3F, [](int) { return 0U; });
  const std::vector<Halves> before = nothing.light;
  smooth(sure.light, sure.points, sure.samples, width);
  smooth(nothing.light, nothing.points, nothing.samples, width);
  EXPECT_LT(sure.error(0, width), 1e-3);
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_TRUE((nothing.light[i].a == before[i].a).all() && (nothing.light[i].b == before[i].b).all());
}

// A trough of liquid with a ball in it, on a ground.
struct Still {
  formats::Frame frame;
  Box box;
  World world;
  Lighting lighting;
  PathTracer tracer;
  Camera camera;

  static SolidMesh ball() {
    Scene scene;
    scene.solids.resize(1);
    scene.solids[0].shape = scene::Sphere{0.3};
    return make_solids(scene)[0];
  }
  explicit Still(std::size_t material, const Lighting& light) : Still(test::trough(12, 0.03), material, light) {}
  Still(formats::Frame sheet, std::size_t material, const Lighting& light)
      : frame(std::move(sheet)), box(test::box_of(frame)),
        world(make_surface(middle_of(frame), 1e-4), {ball()}, {Eigen::Isometry3d::Identity()},
              {{ground_id, {0, -0.52, 0}, Vector3::UnitY()}}, box),
        lighting(light), tracer(world, lighting, {preset(material)}, {{Colour::Constant(0.6F)}}),
        camera(test::frame_box(box, {}, Vector3::UnitY(), 1, 0.05)) {}

  [[nodiscard]] static DrawOptions options(int samples) {
    DrawOptions result;
    result.width = result.height = 64;
    result.samples = samples;
    return result;
  }
  [[nodiscard]] Picture denoised(int samples) const {
    return draw_denoised(world, camera, tracer, options(samples), nullptr);
  }
  [[nodiscard]] Picture plain(int samples) const {
    return draw(
        world, camera,
        [&](const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
          return tracer.radiance(ray, sampler, rays).sum();
        },
        options(samples), nullptr);
  }
};

Lighting studio() { return Lighting::studio(Vec(0.3F, 0.4F, 0.8F).normalized(), Vec::UnitY()); }

double distance(const Picture& a, const Picture& b) { // in levels of 255
  double squares = 0;
  for (std::size_t i = 0; i < a.light.pixels.size(); ++i) {
    const double d =
        static_cast<double>(display_level(luminance(a.light.pixels[i])) - display_level(luminance(b.light.pixels[i])));
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(a.light.pixels.size()));
}

// What is cut out, laid over the background that it has been cut out of, is the whole picture; where there is nothing
// of the sheet and solids it is clear, ground or not.
TEST(CutOut, LaidOverItsBackgroundIsThePicture) {
  const Lighting light = Lighting::uniform(1);
  for (const std::size_t material : {0, 2, 4}) { // chocolate, honey, glass
    const Still still(material, light);
    const World without(make_surface(middle_of(still.frame), 1e-4), {Still::ball()}, {Eigen::Isometry3d::Identity()},
                        {}, still.box);
    const auto drawn = [&](const World& world, bool cut_out, bool denoise) {
      Surroundings around{{Colour::Constant(0.6F)}};
      around.cut_out = cut_out;
      const PathTracer tracer(world, light, {preset(material)}, around);
      if (denoise)
        return draw_denoised(world, still.camera, tracer, Still::options(16), nullptr);
      const auto shader = [&](const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
        return tracer.radiance(ray, sampler, rays).sum();
      };
      const auto coverage = [&](const Ray& ray, std::uint64_t& rays) { return tracer.coverage(ray, rays); };
      return draw(world, still.camera, shader, Still::options(16), nullptr, cut_out ? coverage : Coverage());
    };
    for (const bool denoise : {false, true}) {
      const Picture whole = drawn(without, false, denoise), cut = drawn(without, true, denoise);
      ASSERT_TRUE(whole.alpha.empty());
      Picture laid = cut;
      for (std::size_t i = 0; i < cut.alpha.size(); ++i)
        laid.light.pixels[i] += 1 - cut.alpha[i];
      EXPECT_LT(distance(laid, whole), 3) << liquid_names()[material] << (denoise ? ", denoised" : "");
      const Picture on_ground = drawn(still.world, true, denoise);
      for (const Picture* picture : {&cut, &on_ground}) {
        EXPECT_EQ(picture->alpha.front(), 0); // a corner of the picture
        EXPECT_EQ(picture->light.pixels.front().maxCoeff(), 0);
        EXPECT_GT(std::ranges::count_if(picture->alpha, [](float a) { return a > 0.9999F; }), 400); // the ball
      }
    }
  }
}

TEST(Denoised, IsNearerToTheTruthThanSixTimesTheSamples) {
  for (const std::size_t material : {0, 2, 4, 5}) { // chocolate, honey, glass, film
    const Still still(material, studio());
    const Picture truth = still.plain(128), rough = still.plain(24), denoised = still.denoised(4);
    EXPECT_LT(distance(denoised, truth), distance(rough, truth)) << liquid_names()[material];
    EXPECT_LT(denoised.noise, 0.5F * rough.noise) << liquid_names()[material];
  }
}

// Disks of clear honey one above the other, each with its two faces, before a ground.
TEST(Denoised, ClearLayersAreNoCliff) {
  constexpr int layers = 8;
  formats::Frame frame;
  std::vector<Vector3> x;
  std::vector<Corners> triangles;
  std::vector<double> volume;
  for (int layer = 0; layer < layers; ++layer) {
    const formats::Frame one = test::grid(6, 0.03, [&](double s, double t) {
      const double a = 0.7 * layer, u = s - 0.5, v = 0.5 - t; // turned against the others
      return Vector3(std::cos(a) * u - std::sin(a) * v, 0.06 * layer, std::sin(a) * u + std::cos(a) * v);
    });
    const auto first = static_cast<std::uint32_t>(x.size());
    x.insert(x.end(), positions(one).begin(), positions(one).end());
    for (const Corners& t : sheet::triangles(one))
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    volume.insert(volume.end(), volumes(one).begin(), volumes(one).end());
  }
  const Still still(make_frame(x, triangles, volume), 2, studio());
  const Picture picture = still.denoised(4);
  EXPECT_LT(static_cast<double>(picture.rays) / static_cast<double>(picture.light.pixels.size()),
            160); // 216 with 32 rays along all edges and a shadow ray for every glimmer
}

TEST(Denoised, ALensBlursAsItDoesWithoutSmoothing) {
  Still still(0, studio());
  const double distance_to_middle = still.camera.eye().norm();
  const Picture sharp = still.plain(128);
  still.camera.set_lens({0.1, 0.7 * distance_to_middle});
  const Picture truth = still.plain(256), denoised = still.denoised(8); // with four samples it hangs on the numbers
  EXPECT_LT(distance(denoised, truth), distance(sharp, truth) / 2);
  EXPECT_LT(distance(denoised, truth), distance(still.plain(24), truth) / 2);
}

TEST(Denoised, NeitherTakesNorAddsLight) {
  for (std::size_t material = 0; material < liquid_names().size(); ++material) {
    const Still still(material, studio());
    const auto mean = [](const Picture& picture) {
      double sum = 0;
      for (const Colour& c : picture.light.pixels)
        sum += static_cast<double>(luminance(c));
      return sum / static_cast<double>(picture.light.pixels.size());
    };
    EXPECT_NEAR(mean(still.denoised(16)) / mean(still.plain(64)), 1, 0.01) << liquid_names()[material];
  }
}

TEST(Denoised, TheSameBitsForAnyNumberOfThreads) {
  const Still still(2, studio());
  std::vector<Colour> first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const Picture picture = still.denoised(4);
    if (first.empty())
      first = picture.light.pixels;
    for (std::size_t i = 0; i < first.size(); ++i)
      ASSERT_TRUE((first[i] == picture.light.pixels[i]).all()) << threads << " threads, pixel " << i;
  }
}

} // namespace
} // namespace sheet::render
