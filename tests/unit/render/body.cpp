// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that touch as one body: what they let through, against one slab as thick; layers apart, bit for bit.
#include "libsheet/render/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/render/path_tracer.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

constexpr double layer_thickness = 0.01; // of a layer

// Frames as one.
formats::Frame together(const std::vector<formats::Frame>& frames) {
  std::vector<Vector3> x;
  std::vector<Corners> triangles;
  std::vector<double> volume;
  for (const formats::Frame& one : frames) {
    const auto first = static_cast<std::uint32_t>(x.size());
    for (const Corners& t : sheet::triangles(one))
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    x.insert(x.end(), positions(one).begin(), positions(one).end());
    volume.insert(volume.end(), volumes(one).begin(), volumes(one).end());
  }
  return make_frame(x, triangles, volume);
}

// A level square layer between these x, of n x n squares.
formats::Frame layer_at(int n, double thick, double height, double left, double right) {
  return test::grid(n, thick, [=](double s, double t) {
    return Vector3(left + (right - left) * s, height, (right - left) * (0.5 - t));
  });
}

// Level layers one above the other, `apart` thicknesses from middle to middle.
formats::Frame stack(int layers, double apart, double thick = layer_thickness) {
  std::vector<formats::Frame> all;
  for (int layer = 0; layer < layers; ++layer)
    all.push_back(layer_at(8, thick, apart * layer_thickness * layer, -0.5, 0.5));
  return together(all);
}

enum class Drawn { as_body, as_layers };

// `liquids`: number of each of the frame's triangles; empty: all are one.
std::unique_ptr<World> world_of(const formats::Frame& frame, Drawn drawn, const std::vector<Plane>& planes = {},
                                const std::vector<std::uint32_t>& liquids = {}) {
  Surface surface = make_surface(middle_of(frame), 1e-6);
  for (std::size_t t = 0; !liquids.empty() && t < surface.triangles.size(); ++t)
    surface.liquids.push_back(liquids[surface.source_triangle[t]]);
  return drawn == Drawn::as_body
             ? world_of_bodies(surface, {}, {}, planes, test::box_of(frame))
             : std::make_unique<World>(surface, std::vector<SolidMesh>{}, std::vector<Eigen::Isometry3d>{}, planes,
                                       test::box_of(frame));
}

// Light from below alone: what comes up is what was let through.
Lighting from_below() {
  Image map(64, 32);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      map.at(x, y) = Colour::Constant(y < 16 ? 0.0F : 1.0F);
  return Lighting::surroundings(std::move(map), Vec::UnitZ(), Vec::UnitY());
}

// The means of what comes along rays, so many degrees above level, that meet the layers far from their rims.
std::vector<Colour> seen_in(const World& world, const PathTracer& tracer, double degrees, int samples) {
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

std::vector<Colour> seen(const formats::Frame& frame, const Liquid& liquid, Drawn drawn, double degrees, int samples,
                         const Lighting& light = from_below()) {
  const std::unique_ptr<World> world = world_of(frame, drawn);
  return seen_in(*world, {*world, light, {liquid}, {}, drawn == Drawn::as_body ? Body(*world) : Body()}, degrees,
                 samples);
}

const Liquid clear{1.5F, {0, 1, 2}, Colour::Zero()}; // lets pass 0.82 of blue light over ten layers

TEST(FacesAhead, AreThoseThatRaysFromEachToTheNextFind) {
  const formats::Frame frame = stack(12, 0.98);
  const auto world = world_of(frame, Drawn::as_body, {{ground_id, Vector3(0, -0.1, 0), Vector3::UnitY()}});
  for (int i = 0; i < 200; ++i) {
    const Vec start(0.6F * std::sin(2.1F * static_cast<float>(i)), 0.5F, 0.6F * std::cos(3.3F * static_cast<float>(i)));
    const Vec aim(0.4F * std::cos(1.7F * static_cast<float>(i)), -0.1F, 0.4F * std::sin(0.7F * static_cast<float>(i)));
    Ray ray{start, (aim - start).normalized()};
    FacesAhead ahead(*world, ray);
    std::uint64_t traversals = 0;
    int faces = 0;
    for (Hit hit = world->nearest(ray); hit.anything(); hit = world->nearest(ray), ++faces) {
      const Hit told = ahead.hit(ahead.next(traversals));
      ASSERT_EQ(told.id, hit.id) << "ray " << i << ", face " << faces;
      EXPECT_NEAR(told.distance, hit.distance, 3e-5F);
      // Those rays go aside by 1e-6 at each face, along its normal.
      EXPECT_LT((told.position - hit.position).norm(), 2e-6F * static_cast<float>(faces + 1) / -ray.direction.y());
      EXPECT_LT((told.normal - hit.normal).norm(), 0.01F);
      if (hit.plane)
        break;
      ray = leave(hit, ray.direction);
    }
    if (!world->nearest(ray).plane) {
      EXPECT_FALSE(ahead.next(traversals).anything()) << "ray " << i << " behind " << faces;
    }
    EXPECT_LE(traversals, static_cast<std::uint64_t>(faces) / 16 + 1);
  }
}

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

TEST(Body, LayersOfTwoLiquidsThatTouchStayTwoSlabs) {
  // As two slabs far from each other do, each of its liquid: the upper one takes blue light, the lower one red.
  const std::vector<Liquid> liquids{{1.5F, {0, 1, 8}, Colour::Zero()}, {1.4F, {20, 1, 0}, Colour::Zero()}};
  const Lighting light = from_below();
  const auto through = [&](double apart) {
    const formats::Frame frame = stack(2, apart);
    std::vector<std::uint32_t> numbers(frame.triangles, 0);
    std::fill(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2), 1U);
    const std::unique_ptr<World> world = world_of(frame, Drawn::as_body, {}, numbers);
    return seen_in(*world, {*world, light, liquids, {}, Body(*world)}, 70, 4096)[1];
  };
  const Colour far = through(4);
  EXPECT_LT(far[0], 0.85F * far[1]);
  EXPECT_LT(far[2], 0.97F * far[1]);
  for (const double apart : {0.98, 1.0, 1.05, 1.5})
    EXPECT_LT((through(apart) / far - 1).abs().maxCoeff(), 0.01F) << apart << " thicknesses apart";
}

TEST(Body, WhatTwoLayersLetThroughIsContinuousInTheGapBetweenThem) {
  // From one slab to two, linearly between gaps of half a thickness and of two.
  const auto through = [](const formats::Frame& frame) { return seen(frame, clear, Drawn::as_body, 70, 8192)[1]; };
  const Colour slab = through(stack(1, 1, 2 * layer_thickness)), pair = through(stack(2, 4));
  ASSERT_GT((slab - pair).minCoeff(), 0.05);
  Colour last = slab;
  for (double gap = 0.1; gap < 2.5; gap += 0.15) {
    const Colour now = through(stack(2, 1 + gap));
    const auto bridged = static_cast<float>(std::clamp((2 - gap) / 1.5, 0.0, 1.0));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(now[c], bridged * slab[c] + (1 - bridged) * pair[c], 0.003) << "gap " << gap << ", channel " << c;
      EXPECT_LE(now[c], last[c] + 1e-4F) << "gap " << gap << ", channel " << c;
    }
    last = now;
  }
}

TEST(Body, NormalsTurnContinuouslyAsLayersComeNear) {
  // Of a layer along the rim of another that covers half of it: the rim melts in as it comes near.
  const auto slopes = [](double gap) {
    const formats::Frame frame = together({layer_at(40, layer_thickness, 0, -0.1, 0.1),
                                           layer_at(40, layer_thickness, (1 + gap) * layer_thickness, -0.2, 0.0013)});
    const std::unique_ptr<World> world = world_of(frame, Drawn::as_body);
    const Body body(*world);
    std::vector<float> result;
    for (int i = 0; i < 20; ++i) {
      const Vec from = world->to_world(Vector3(0.008 + 0.001 * i, 1, 0.003));
      result.push_back(body.normal_at(*world, world->nearest({from, -Vec::UnitY()})).x());
    }
    return result;
  };
  const auto difference = [](const std::vector<float>& a, const std::vector<float>& b) {
    float most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  };
  std::vector<float> last = slopes(0.3);
  const float all = difference(last, slopes(2.2));
  EXPECT_GT(all, 0.05F);
  for (double gap = 0.35; gap < 2.2; gap += 0.05) {
    const std::vector<float> now = slopes(gap);
    EXPECT_LT(difference(now, last), 0.25F * all) << "gap " << gap;
    last = now;
  }
}

TEST(Body, LayersByThemselvesAreAPileOfPlates) {
  // T = (1 - F) / (1 + (2 N - 1) F) of 2 N faces that each reflect F [Stokes 1862].
  const double face = 0.04, expected = (1 - face) / (1 + 19 * face);
  for (const Colour& c : seen(stack(10, 1.05), clear, Drawn::as_layers, 90, 8192))
    EXPECT_NEAR(static_cast<double>(c[0]) / expected, 1, 0.02);
}

// The mean luminance along a ray under even light.
double luminance_along(const formats::Frame& frame, Drawn drawn, std::size_t liquid, const Vector3& from,
                       const Vector3& to) {
  const std::unique_ptr<World> world = world_of(frame, drawn);
  const Lighting light = Lighting::uniform(1);
  const PathTracer tracer(*world, light, {preset(liquid)}, {}, drawn == Drawn::as_body ? Body(*world) : Body());
  const Ray ray{world->to_world(from), (to - from).normalized().cast<float>()};
  double sum = 0;
  std::uint64_t rays = 0;
  for (std::uint32_t s = 0; s < 4096; ++s) {
    Sampler sampler(0, s);
    sum += static_cast<double>(luminance(tracer.radiance(ray, sampler, rays).sum())) / 4096;
  }
  return sum;
}

TEST(Body, AGapThatIsOpenToTheEyeIsAsDarkAsWithLayers) {
  // Light in it comes from its mouth, and through opaque layers next to none. The eye looks in from the side.
  const formats::Frame frame = together(
      {layer_at(40, layer_thickness, 0, -0.1, 0.1), layer_at(40, layer_thickness, 2 * layer_thickness, -0.1, 0.1)});
  const auto seen_in = [&](Drawn drawn) {
    return luminance_along(frame, drawn, 3, {-0.11, 0.0125, 0.003}, {-0.07, 0.0055, 0.003});
  };
  const double layers = seen_in(Drawn::as_layers);
  EXPECT_LT(layers, 0.6);
  EXPECT_NEAR(seen_in(Drawn::as_body) / layers, 1, 0.1); // normals melt; 3.6 if light came through the layers
}

TEST(Body, ASharpFoldOfLongEdgesDoesNotShine) {
  // Its smooth normals send mirror images into the chocolate, which the body is deeper of. 5.4 if they went up.
  const auto roof = [](double height) {
    return test::grid(2, layer_thickness,
                      [=](double s, double t) { return Vector3(s - 0.5, height - std::abs(s - 0.5), 0.5 - t); });
  };
  const formats::Frame frame = together({roof(0), roof(-1.6 * layer_thickness)});
  const auto seen_on = [&](Drawn drawn) {
    return luminance_along(frame, drawn, 0, {1.1, 0.0, 0.003}, {0.1, -0.1, 0.003});
  };
  EXPECT_LT(seen_on(Drawn::as_body), 2 * seen_on(Drawn::as_layers));
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
    const std::unique_ptr<World> built = world_of(frame, drawn, {{ground_id, Vector3(0, -0.2, 0), Vector3::UnitY()}});
    const World& world = *built;
    const Lighting light = from_below();
    const PathTracer tracer(world, light, {clear}, {}, drawn == Drawn::as_body ? Body(world) : Body());
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
