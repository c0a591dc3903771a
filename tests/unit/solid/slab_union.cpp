// SPDX-License-Identifier: GPL-3.0-or-later
// Layers as one body: volumes in closed form, gaps and voids, closedness, where points come from.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>

#include "libsheet/base/parallel.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/solid/distance_field.h"
#include "libsheet/solid/slab_union.h"
#include "libsheet/solid/triangle_distance.h"
#include "tests/unit/own_path.h"
#include "tests/unit/solid/solid_support.h"

namespace sheet::solid {
namespace {

struct Layers {
  std::vector<Vector3> points;
  std::vector<double> thickness;
  std::vector<Corners> triangles;

  [[nodiscard]] Slabs slabs() const { return {points, thickness, triangles}; }
  void add(const std::vector<Vector3>& x, const std::vector<Corners>& corners, double h) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), x.begin(), x.end());
    thickness.resize(points.size(), h);
    for (const Corners& c : corners)
      triangles.push_back({first + c[0], first + c[1], first + c[2]});
  }
  // A square of side `side` around the z axis, its heights by place.
  template <class Height> void add_square(double side, int cells, double h, Height height) {
    std::vector<Vector3> x;
    std::vector<Corners> corners;
    const auto row = static_cast<std::uint32_t>(cells + 1);
    for (std::uint32_t i = 0; i < row; ++i)
      for (std::uint32_t j = 0; j < row; ++j) {
        const double u = side * (i / static_cast<double>(cells) - 0.5),
                     v = side * (j / static_cast<double>(cells) - 0.5);
        x.emplace_back(u, v, height(u, v));
        if (i + 1 < row && j + 1 < row) {
          const std::uint32_t a = i * row + j;
          corners.push_back({a, a + row, a + row + 1});
          corners.push_back({a, a + row + 1, a + 1});
        }
      }
    add(x, corners, h);
  }
  void add_square(double side, double h, double z) {
    add_square(side, 7, h, [z](double, double) { return z; });
  }
  void add_ball(double radius, int level, double h) {
    const SolidSurface ball = surface_of(test::icosphere(level));
    std::vector<Vector3> x = ball.points;
    for (Vector3& point : x)
      point *= radius;
    add(x, ball.triangles, h);
  }
  [[nodiscard]] double volume() const {
    double sum = 0;
    for (const Corners& c : triangles)
      sum += (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]).norm() / 2 *
             (thickness[c[0]] + thickness[c[1]] + thickness[c[2]]) / 3;
    return sum;
  }
};

double volume_of(const SolidSurface& surface) {
  double sum = 0;
  for (const Corners& c : surface.triangles)
    sum += surface.points[c[0]].dot(surface.points[c[1]].cross(surface.points[c[2]])) / 6;
  return sum;
}

// Whether every edge has two faces, one on either side.
bool is_closed(const SolidSurface& surface) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (const Corners& c : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (!sides.emplace(c[i], c[(i + 1) % 3]).second)
        return false;
  for (const auto& [from, to] : sides)
    if (!sides.contains({to, from}))
      return false;
  return !sides.empty();
}

// The volumes of the parts that do not hang together.
std::vector<double> parts_of(const SolidSurface& surface) {
  DisjointSets sets(surface.points.size());
  for (const Corners& c : surface.triangles) {
    sets.join(c[0], c[1]);
    sets.join(c[0], c[2]);
  }
  std::map<std::uint64_t, double> volumes;
  for (const Corners& c : surface.triangles)
    volumes[sets.find(c[0])] += surface.points[c[0]].dot(surface.points[c[1]].cross(surface.points[c[2]])) / 6;
  std::vector<double> result;
  for (const auto& [first, volume] : volumes)
    result.push_back(volume);
  return result;
}

constexpr double h = 0.002;

UnionOptions options_for(const Layers& layers, double close = h / 4) {
  return {.volume = layers.volume(), .voxel = h / 4, .close = close, .thickness = h};
}

// Steiner's formula: a plate of area A and perimeter P with all that is within h/2 of it.
TEST(SlabUnion, OfASlabHasItsVolumeInClosedForm) {
  Layers layers;
  layers.add_square(0.1, h, 0);
  const double exact = 0.01 * h + std::numbers::pi * h * h * 0.4 / 8 + std::numbers::pi * h * h * h / 6;
  for (const double close : {0.0, h / 4}) {
    const SlabUnion body = unite(layers.slabs(), options_for(layers, close));
    EXPECT_NEAR(body.union_volume / exact, 1, 0.002);
    EXPECT_TRUE(is_closed(body.surface));
    EXPECT_EQ(parts_of(body.surface).size(), 1U);
    EXPECT_NEAR(volume_of(body.surface) / layers.volume(), 1, 1e-6);
    EXPECT_LT(body.shift, 0); // the round edges are beyond what the liquid has
    EXPECT_NEAR(body.shift, (layers.volume() - exact) / 0.02, 0.1 * h / 4);
    EXPECT_TRUE(body.volume_reached);
  }
}

TEST(SlabUnion, DoesNotDependOnOrientationPlaceOrSize) {
  Layers layers, other;
  layers.add_square(0.03, h, 0);
  other = layers;
  for (Corners& c : other.triangles)
    std::swap(c[1], c[2]);
  EXPECT_NEAR(unite(other.slabs(), options_for(other)).union_volume /
                  unite(layers.slabs(), options_for(layers)).union_volume,
              1, 1e-6);
  for (Vector3& x : other.points)
    x = 1e3 * x + Vector3(7e5, -3e5, 2e5);
  for (double& thickness : other.thickness)
    thickness *= 1e3;
  UnionOptions options = options_for(layers);
  options.volume *= 1e9;
  options.voxel *= 1e3;
  options.close *= 1e3;
  const SlabUnion large = unite(other.slabs(), options);
  EXPECT_NEAR(large.union_volume / unite(layers.slabs(), options_for(layers)).union_volume / 1e9, 1, 1e-4);
  EXPECT_NEAR((large.surface.points[0] - Vector3(7e5, -3e5, 2e5)).norm(), 15 * std::sqrt(2), 3);
}

TEST(SlabUnion, OfTouchingLayersIsOneBodyWithoutVoids) {
  Layers layers;
  for (const double z : {0.0, h, 2 * h})
    layers.add_square(0.03, h, z);
  for (const bool keep : {true, false}) {
    UnionOptions options = options_for(layers);
    options.keep_voids = keep;
    const SlabUnion body = unite(layers.slabs(), options);
    EXPECT_EQ(parts_of(body.surface).size(), 1U);
    EXPECT_EQ(body.voids, 0U);
    EXPECT_TRUE(is_closed(body.surface));
    EXPECT_NEAR(volume_of(body.surface) / layers.volume(), 1, 1e-6);
  }
}

TEST(SlabUnion, OfLayersInEachOtherHasTheWholeVolume) {
  Layers layers;
  for (const double z : {0.0, 0.8 * h})
    layers.add_square(0.03, h, z);
  const SlabUnion body = unite(layers.slabs(), options_for(layers));
  EXPECT_LT(body.union_volume, 0.97 * (layers.volume() + std::numbers::pi * h * h * 0.12 / 4)); // with round edges
  EXPECT_NEAR(volume_of(body.surface) / layers.volume(), 1, 1e-6);
  EXPECT_TRUE(body.volume_reached);
}

TEST(SlabUnion, ThatCannotHoldTheVolumeSaysSo) {
  Layers layers;
  for (int i = 0; i < 6; ++i)
    layers.add_square(0.03, h, 0);
  EXPECT_FALSE(unite(layers.slabs(), options_for(layers)).volume_reached);
}

TEST(SlabUnion, ClosesGapsByLength) {
  for (const auto& [gap, parts] : {std::pair(0.4, 1U), std::pair(3.0, 2U)}) {
    const double close = h / 2;
    Layers layers;
    layers.add_square(0.03, h, 0);
    layers.add_square(0.03, h, h + gap * close);
    const SlabUnion body = unite(layers.slabs(), options_for(layers, close));
    EXPECT_EQ(parts_of(body.surface).size(), parts) << "gap " << gap;
    EXPECT_TRUE(is_closed(body.surface));
    EXPECT_NEAR(volume_of(body.surface) / layers.volume(), 1, 1e-6);
    EXPECT_EQ(parts_of(unite(layers.slabs(), options_for(layers, 0)).surface).size(), 2U) << "gap " << gap;
  }
}

// Closing leaves alone what no gap is near: a corner of the body goes nowhere.
TEST(SlabUnion, ClosingChangesNothingOfASingleLayer) {
  Layers layers;
  layers.add_square(0.03, h, 0);
  const SlabUnion as_is = unite(layers.slabs(), options_for(layers, 0)),
                  closed = unite(layers.slabs(), options_for(layers, h / 2));
  EXPECT_NEAR(closed.shift, as_is.shift, 0.02 * h);
  double farthest = 0, as_far = 0;
  for (const Vector3& x : as_is.surface.points)
    farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  for (const Vector3& x : closed.surface.points)
    as_far = std::max(as_far, x.cwiseAbs().maxCoeff());
  EXPECT_NEAR(as_far, farthest, 0.05 * h);
}

// Where two faces meet, closing leaves the arc of a circle that touches both. The surface is shifted outward of it.
TEST(SlabUnion, ClosingRoundsACornerByItsLength) {
  for (const double close : {h / 2, h, 2 * h}) {
    Layers layers;
    layers.add_square(0.03, h, 0);
    layers.add_square(0.03, h, 0);
    const double tilt = 0.3, sine = std::sin(tilt), cosine = std::cos(tilt);
    for (std::size_t i = 0; i < layers.points.size(); ++i) { // the second across the first, both askew to the voxels
      Vector3& x = layers.points[i];
      if (2 * i >= layers.points.size())
        x = Vector3(0, x.y(), x.x());
      x = Vector3(cosine * x.x() - sine * x.z(), x.y(), sine * x.x() + cosine * x.z());
    }
    const SlabUnion body = unite(layers.slabs(), options_for(layers, close));
    double sum = 0, most = 0;
    int count = 0;
    for (const Vector3& x : body.surface.points) {
      const double u = std::abs(cosine * x.x() + sine * x.z()) - h / 2 - close,
                   w = std::abs(cosine * x.z() - sine * x.x()) - h / 2 - close, away = std::hypot(u, w);
      if (std::abs(x.y()) > 0.01 || std::max(u, w) > -0.3 * away)
        continue;                                                 // not on the middle of the arc
      const double error = (close - body.shift - away) / (h / 4); // in voxels
      sum += error;
      most = std::max(most, std::abs(error));
      ++count;
    }
    ASSERT_GT(count, 100);
    EXPECT_LT(std::abs(sum / count), 0.3) << close;
    EXPECT_LT(most, 0.4) << close;
  }
}

TEST(SlabUnion, OfAShellHasAnInnerSurfaceIfVoidsAreKept) {
  Layers layers;
  const double radius = 0.02;
  layers.add_ball(radius, 3, h);
  UnionOptions options = options_for(layers);
  const SlabUnion filled = unite(layers.slabs(), options);
  EXPECT_EQ(filled.voids, 1U);
  ASSERT_EQ(parts_of(filled.surface).size(), 1U);
  EXPECT_TRUE(is_closed(filled.surface));
  const double outer = 4 * std::numbers::pi / 3 * std::pow(radius + h / 2, 3);
  const double inner = 4 * std::numbers::pi / 3 * std::pow(radius - h / 2, 3);
  EXPECT_NEAR(volume_of(filled.surface) / outer, 1, 0.02); // the air does not count: nothing has shrunk
  EXPECT_NEAR(filled.air / inner, 1, 0.05);
  options.keep_voids = true;
  const SlabUnion kept = unite(layers.slabs(), options);
  EXPECT_TRUE(is_closed(kept.surface));
  const std::vector<double> parts = parts_of(kept.surface);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(std::max(parts[0], parts[1]) / outer, 1, 0.02);
  EXPECT_NEAR(std::min(parts[0], parts[1]) / inner, -1, 0.02);
  EXPECT_NEAR(volume_of(kept.surface) / layers.volume(), 1, 1e-6);
}

TEST(SlabUnion, DropsWhatIsInsideOfAVoidWithIt) {
  Layers layers;
  layers.add_ball(0.02, 3, h);
  layers.add_square(0.005, h, 0);
  UnionOptions options = options_for(layers);
  EXPECT_EQ(parts_of(unite(layers.slabs(), options).surface).size(), 1U);
  options.keep_voids = true;
  EXPECT_EQ(parts_of(unite(layers.slabs(), options).surface).size(), 3U);
}

// Between two layers whose borders touch: narrower than they are thick, so it is taken for liquid.
TEST(SlabUnion, NarrowVoidsCountAsLiquid) {
  Layers layers;
  layers.add_square(0.03, h, 0);
  layers.add_square(0.03, 20, h,
                    [](double x, double y) { return h + 0.8 * h * std::max(0.0, 1 - 100 * std::hypot(x, y)); });
  UnionOptions options = options_for(layers, h / 16);
  const SlabUnion body = unite(layers.slabs(), options);
  EXPECT_GE(body.voids, 1U);
  EXPECT_EQ(body.air, 0);
  EXPECT_EQ(parts_of(body.surface).size(), 1U);
  EXPECT_NEAR(volume_of(body.surface) / layers.volume(), 1, 1e-6);
  options.keep_voids = true;
  EXPECT_GT(parts_of(unite(layers.slabs(), options).surface).size(), 1U);
}

Layers tangle() {
  Layers layers;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.01, 0.01), share(0.5, 1.5);
  for (int i = 0; i < 60; ++i) {
    std::vector<Vector3> x;
    for (int k = 0; k < 3; ++k)
      x.emplace_back(place(random), place(random), place(random));
    layers.add(x, {{0, 1, 2}}, h);
  }
  for (double& thickness : layers.thickness)
    thickness *= share(random);
  layers.add({Vector3(0, 0, 0.02), Vector3(0.005, 0, 0.02), Vector3(0.01, 0, 0.02), Vector3(0, 0, 0.02)},
             {{0, 1, 2}, {0, 3, 0}}, h); // no area
  return layers;
}

TEST(SlabUnion, PointsComeFromTheTriangleOfTheLeastField) {
  const Layers layers = tangle();
  const SlabUnion body = unite(layers.slabs(), options_for(layers));
  const auto field = [&](const Vector3& x, std::size_t t) {
    const Corners& c = layers.triangles[t];
    const NearestOnTriangle near =
        nearest_on_triangle(x, {layers.points[c[0]], layers.points[c[1]], layers.points[c[2]]});
    double thickness = 0;
    for (std::size_t i = 0; i < 3; ++i)
      thickness += near.weights[i] * layers.thickness[c[i]];
    return (x - near.point).norm() - thickness / 2;
  };
  ASSERT_EQ(body.origins.size(), body.surface.points.size());
  ASSERT_GT(body.origins.size(), 1000U);
  for (std::size_t i = 0; i < body.origins.size(); i += 7) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < layers.triangles.size(); ++t)
      least = std::min(least, field(body.surface.points[i], t));
    EXPECT_NEAR(field(body.surface.points[i], body.origins[i].triangle), least, 1e-4 * h);
    const auto& weights = body.origins[i].weights;
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
  }
}

TEST(SlabUnion, OfATangleIsClosed) {
  const Layers layers = tangle();
  for (const double close : {0.0, h / 8, h}) {
    const SlabUnion body = unite(layers.slabs(), options_for(layers, close));
    EXPECT_TRUE(is_closed(body.surface));
    EXPECT_GT(body.surface.triangles.size(), 1000U);
  }
}

TEST(SlabUnion, SameBitsForAnyNumberOfThreads) {
  Layers layers = tangle();
  layers.add_ball(0.015, 3, h);
  UnionOptions options = options_for(layers);
  options.level_set = true;
  SlabUnion first;
  for (const int threads : {1, 2, 2, 3}) {
    const ThreadLimit limit(threads);
    SlabUnion body = unite(layers.slabs(), options);
    ASSERT_FALSE(body.surface.points.empty());
    if (first.surface.points.empty()) {
      first = std::move(body);
      continue;
    }
    EXPECT_EQ(body.surface.points, first.surface.points);
    EXPECT_EQ(body.surface.triangles, first.surface.triangles);
    EXPECT_TRUE(body.level_set == first.level_set);
    for (std::size_t i = 0; i < first.origins.size(); ++i)
      ASSERT_EQ(body.origins[i].triangle, first.origins[i].triangle);
  }
}

TEST(SlabUnion, LevelSetIsThatOfTheSurface) {
  Layers layers;
  layers.add_ball(0.02, 3, h);
  layers.add_square(0.03, h, 0.03);
  UnionOptions options = options_for(layers);
  options.level_set = true;
  options.time = 1.25;
  const SlabUnion body = unite(layers.slabs(), options);
  const std::string file = test::own_path("slab_union.vdb");
  std::ofstream(file, std::ios::binary) << body.level_set;
  const SolidSurface surface = read_level_set(file);
  EXPECT_EQ(parts_of(surface).size(), parts_of(body.surface).size()); // the void of the ball is filled
  EXPECT_NEAR(volume_of(surface) / volume_of(body.surface), 1, 0.002);
  openvdb::initialize();
  openvdb::io::File input(file);
  input.open(false);
  const openvdb::GridBase::Ptr grid = input.readGrid("surface");
  std::filesystem::remove(file);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_DOUBLE_EQ(grid->voxelSize().x(), h / 4);
  EXPECT_EQ(grid->metaValue<double>("time"), 1.25);
  EXPECT_FLOAT_EQ(openvdb::gridPtrCast<openvdb::FloatGrid>(grid)->background(), static_cast<float>(3 * h / 4));
}

TEST(SlabUnion, OfNothingIsNothing) {
  const Layers none;
  UnionOptions options{.volume = 0, .voxel = h / 4, .close = h / 4, .thickness = h, .level_set = true};
  const SlabUnion body = unite(none.slabs(), options);
  EXPECT_TRUE(body.surface.triangles.empty());
  EXPECT_FALSE(body.level_set.empty());
}

} // namespace
} // namespace sheet::solid
