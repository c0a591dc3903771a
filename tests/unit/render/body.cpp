// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that touch as one body: what they let through, against one slab as thick; layers apart, bit for bit.
#include "libsheet/render/body.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/render/path_tracer.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

constexpr double layer_thickness = 0.01; // of a layer

// Level layers one above the other, `apart` thicknesses from middle to middle.
formats::Frame stack(int layers, double apart, double thick = layer_thickness) {
  const formats::Frame one = test::flat(8, thick);
  std::vector<Vector3> x;
  std::vector<Corners> triangles;
  std::vector<double> volume;
  for (int layer = 0; layer < layers; ++layer) {
    const auto first = static_cast<std::uint32_t>(x.size());
    for (const Vector3& p : positions(one))
      x.emplace_back(p + apart * layer_thickness * layer * Vector3::UnitY());
    for (const Corners& t : sheet::triangles(one))
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    volume.insert(volume.end(), volumes(one).begin(), volumes(one).end());
  }
  return make_frame(x, triangles, volume);
}

enum class Drawn { as_body, as_layers };

// Light from below alone: what comes up is what was let through.
Lighting from_below() {
  Image map(64, 32);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y) = Colour::Constant(y < 16 ? 0.0F : 1.0F);
  return Lighting::surroundings(std::move(map), Vec::UnitZ(), Vec::UnitY());
}

// The means of what comes along rays, so many degrees above level, that meet the layers far from their rims.
std::vector<Colour> seen(const formats::Frame& frame, const Liquid& liquid, Drawn drawn, double degrees, int samples,
                         const Lighting& light = from_below()) {
  const World world(make_surface(frame, 1e-6), {}, {}, {}, test::box_of(frame));
  const PathTracer tracer(world, light, liquid, {}, drawn == Drawn::as_body ? Body(world) : Body());
  const double angle = degrees * std::numbers::pi / 180;
  const Vector3 direction(std::cos(angle), -std::sin(angle), 0);
  std::vector<Colour> result;
  for (std::uint32_t pixel = 0; pixel < 3; ++pixel) {
    const Ray ray{world.to_world(Vector3(0.013 + 0.04 * pixel, 0.05, 0.007) - direction), direction.cast<float>()};
    Colour sum = Colour::Zero();
    std::uint64_t rays = 0;
    for (int s = 0; s < samples; ++s) {
      Sampler sampler(pixel, static_cast<std::uint32_t>(s));
      sum += tracer.radiance(ray, sampler, rays).sum() / static_cast<float>(samples);
    }
    result.push_back(sum);
  }
  return result;
}

const Liquid clear{1.5F, {0, 1, 2}, Colour::Zero()}; // lets pass 0.82 of blue light over ten layers

TEST(Body, TenLayersThatTouchLetThroughWhatOneSlabDoes) {
  for (const double degrees : {90.0, 50.0}) {
    const std::vector<Colour> slab = seen(stack(1, 1, 10 * layer_thickness), clear, Drawn::as_layers, degrees, 1);
    for (const double apart : {1.0, 0.98, 1.05}) {
      const std::vector<Colour> body = seen(stack(10, apart), clear, Drawn::as_body, degrees, 1);
      for (std::size_t i = 0; i < body.size(); ++i)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(body[i][c] / slab[i][c], 1, 0.01)
              << apart << " thicknesses apart, " << degrees << " degrees, ray " << i << ", channel " << c;
    }
  }
}

TEST(Body, LayersByThemselvesAreAPileOfPlates) {
  // T = (1 - F) / (1 + (2 N - 1) F) of 2 N faces that each reflect F [Stokes 1862].
  const double face = 0.04, expected = (1 - face) / (1 + 19 * face);
  for (const Colour& c : seen(stack(10, 1.05), clear, Drawn::as_layers, 90, 8192))
    EXPECT_NEAR(static_cast<double>(c[0]) / expected, 1, 0.02);
}

TEST(Body, WhatDoesNotTouchIsDrawnAsBefore) {
  const auto same = [](const formats::Frame& frame) {
    const std::vector<Colour> body = seen(frame, preset(2), Drawn::as_body, 50, 64),
                              layers = seen(frame, preset(2), Drawn::as_layers, 50, 64);
    bool result = true;
    for (std::size_t i = 0; i < body.size(); ++i)
      result = result && (body[i] == layers[i]).all();
    return result;
  };
  EXPECT_TRUE(same(stack(1, 1)));
  EXPECT_TRUE(same(stack(2, 4)));
  EXPECT_TRUE(same(test::trough(24, 0.03)));
  EXPECT_FALSE(same(stack(2, 1.05)));
}

TEST(Body, NoLightIsLost) {
  for (const std::size_t which : {2, 3}) { // honey, batter
    Liquid liquid = preset(which);
    liquid.absorption.setZero();
    for (const double degrees : {90.0, 20.0})
      for (const Colour& c : seen(stack(10, 1.02), liquid, Drawn::as_body, degrees, 1024, Lighting::uniform(1)))
        EXPECT_NEAR(c.mean(), 1, 0.01) << liquid_names()[which] << ", " << degrees << " degrees";
  }
}

TEST(Body, WhatIsBehindLayersThatTouchIsOneSurfaceTheCameraLooksThrough) {
  // The denoiser's view: the body is met once, however many layers it has.
  const auto weight = [](const formats::Frame& frame, Drawn drawn) {
    const World world(make_surface(frame, 1e-6), {}, {}, {{ground_id, Vector3(0, -0.2, 0), Vector3::UnitY()}},
                      test::box_of(frame));
    const Lighting light = from_below();
    const PathTracer tracer(world, light, clear, {}, drawn == Drawn::as_body ? Body(world) : Body());
    std::uint64_t rays = 0;
    const Sight sight = tracer.look({world.to_world(Vector3(0.013, 1, 0.007)), -Vec::UnitY()}, rays);
    return std::pair(sight.layers[0].way, sight.layers[0].weight[0]);
  };
  const auto one = weight(stack(1, 1, 10 * layer_thickness), Drawn::as_layers);
  const auto body = weight(stack(10, 1.02), Drawn::as_body);
  EXPECT_EQ(body.first, one.first);
  EXPECT_NEAR(body.second / one.second, 1, 0.01);
  EXPECT_NE(weight(stack(10, 1.02), Drawn::as_layers).first, one.first);
}

} // namespace
} // namespace sheet::render
