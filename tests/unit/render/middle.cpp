// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/middle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/render/surface.h"
#include "tests/support/meshes.h"
#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

constexpr std::size_t plenty = 1'000'000;

double volume_of(const Middle& middle) {
  double volume = 0;
  for (const Corners& t : middle.triangles)
    volume += area_normal(middle.positions, t).norm() *
              (middle.thickness[t[0]] + middle.thickness[t[1]] + middle.thickness[t[2]]) / 3;
  return volume;
}

// How far the middles of triangles lie from the sphere of radius 0.5, in the mean by area.
double off_sphere(const Middle& middle) {
  double sum = 0, area = 0;
  for (const Corners& t : middle.triangles) {
    const Vector3 center = (middle.positions[t[0]] + middle.positions[t[1]] + middle.positions[t[2]]) / 3;
    const double size = area_normal(middle.positions, t).norm();
    sum += size * std::abs(center.norm() - 0.5);
    area += size;
  }
  return sum / area;
}

formats::Frame coarse_ball() { // edges of 32 to 36 degrees
  const sheet::test::Mesh mesh = sheet::test::icosphere(1);
  std::vector<Vector3> x;
  for (const Vector3& v : mesh.positions)
    x.push_back(0.5 * v);
  return make_frame(x, mesh.triangles, std::vector<double>(mesh.triangles.size(), 1e-4));
}

// Of a square metre with edges of 0.1 to 0.14 m, of this thickness at x, z [m].
template <class Thickness> formats::Frame square_of(Thickness&& thickness) {
  formats::Frame frame = test::flat(10, 0.01);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const Vector3 middle = (positions(frame)[c[0]] + positions(frame)[c[1]] + positions(frame)[c[2]]) / 3;
    volumes(frame)[t] *= thickness(middle.x(), middle.z()) / 0.01;
  }
  return frame;
}

TEST(Middle, ASingleThickTriangleIsNoSpike) {
  const formats::Frame crushed =
      square_of([](double x, double z) { return x > 0 && x < 0.1 && z > -x && z < 0 ? 10 : 0.1; });
  const Middle middle = middle_of(crushed);
  double volume = 0;
  for (const double v : volumes(crushed))
    volume += v;
  EXPECT_LT(std::ranges::max(middle.thickness), 0.9); // 1.8 m around one of its corners
  EXPECT_NEAR(volume_of(middle), volume, 1e-12);
}

TEST(Middle, WhatIsThickAsAWholeStaysSo) {
  for (const double thickness : {0.1, 2.0}) {
    const Middle even = middle_of(square_of([&](double, double) { return thickness; }));
    EXPECT_NEAR(std::ranges::min(even.thickness), thickness, 1e-12);
    EXPECT_NEAR(std::ranges::max(even.thickness), thickness, 1e-12);
  }
  const Middle step = middle_of(square_of([&](double x, double) { return x < 0 ? 1 : 0.01; }));
  EXPECT_NEAR(std::ranges::max(step.thickness), 1, 1e-12); // a lump beside a film
}

TEST(Middle, ACoarseBallBecomesRound) {
  const formats::Frame frame = coarse_ball();
  const Middle flat = middle_of(frame), smooth = smoothed(flat, volumes(frame), {plenty});
  ASSERT_EQ(smooth.triangles.size(), 16 * flat.triangles.size());
  EXPECT_GT(off_sphere(flat), 0.02);
  EXPECT_LT(off_sphere(smooth), 0.3 * off_sphere(flat)); // it goes near to the vertices, not through them
  double volume = 0;
  for (const double v : volumes(frame))
    volume += v;
  EXPECT_NEAR(volume_of(smooth), volume, 0.02 * volume);
  for (std::size_t t = 0; t < smooth.triangles.size(); ++t) { // their normals still point outwards
    const Vector3& x = smooth.positions[smooth.triangles[t][0]];
    EXPECT_GT(area_normal(smooth.positions, smooth.triangles[t]).dot(x), 0);
  }
}

TEST(Middle, AsFarAsThereMayBeTriangles) {
  const formats::Frame frame = coarse_ball();
  const Middle flat = middle_of(frame);
  const std::size_t n = flat.triangles.size();
  EXPECT_EQ(smoothed(flat, volumes(frame), {16 * n}).triangles.size(), 16 * n);
  EXPECT_EQ(smoothed(flat, volumes(frame), {4 * n - 1}).positions, flat.positions);
}

TEST(Middle, AsFarAsChordsAreOff) { // of edges of 0.31 that turn by 22 degrees 0.015, of their halves 0.004
  const formats::Frame frame = coarse_ball();
  const Middle flat = middle_of(frame);
  const std::size_t n = flat.triangles.size();
  EXPECT_EQ(smoothed(flat, volumes(frame), {plenty, 0.003}).triangles.size(), 16 * n);
  EXPECT_EQ(smoothed(flat, volumes(frame), {plenty, 0.006}).triangles.size(), 4 * n);
  EXPECT_EQ(smoothed(flat, volumes(frame), {plenty, 0.02}).positions, flat.positions);
}

// A roof of two slopes of 45 degrees over rows of vertices across its ridge, which every other row has a vertex on.
Middle roof(int rows, int half_width) {
  Middle middle;
  const auto at = [&](int row, int i) { return static_cast<std::uint32_t>(row * (2 * half_width + 1) + i); };
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i <= 2 * half_width; ++i) {
      const double across = i - half_width + (row % 2 == 0 ? 0 : 0.5);
      middle.positions.emplace_back(across, -std::abs(across), std::sqrt(3) / 2 * row);
      middle.thickness.push_back(1e-3);
    }
  for (int row = 0; row + 1 < rows; ++row)
    for (int i = 0; i < 2 * half_width; ++i) {
      const std::uint32_t a = at(row, i), b = at(row, i + 1), c = at(row + 1, i), d = at(row + 1, i + 1);
      for (const Corners& t : row % 2 == 0 ? std::array{Corners{a, c, b}, Corners{b, c, d}}
                                           : std::array{Corners{a, c, d}, Corners{a, d, b}}) {
        middle.source_triangle.push_back(static_cast<std::uint32_t>(middle.triangles.size()));
        middle.triangles.push_back(t);
      }
    }
  return middle;
}

// Of the ridge's height over the middles of a row that has a vertex there and of one that has none.
double ripple(const Middle& middle, int row) {
  const auto top = [&](int there) {
    double highest = -1e9;
    for (const Vector3& x : middle.positions)
      if (std::abs(x.z() - std::sqrt(3) / 2 * there) < 0.1)
        highest = std::max(highest, x.y());
    return highest;
  };
  return top(row) - top(row + 1);
}

// As chords come to matter, parts rise from the coarser surface, and so do their normals.
TEST(Middle, FinerPartsBeginOnTheCoarserSurface) {
  const formats::Frame frame = coarse_ball();
  const Middle flat = middle_of(frame);
  for (std::size_t parts : {4, 16}) {
    double kept = 1e-5, lost = 1; // limits with and without those parts
    while (lost / kept > 1.0001) {
      const double limit = std::sqrt(kept * lost);
      (smoothed(flat, volumes(frame), {plenty, limit}).triangles.size() >= parts * flat.triangles.size() ? kept
                                                                                                         : lost) =
          limit;
    }
    const Middle fine = smoothed(flat, volumes(frame), {plenty, kept});
    const Middle coarse = smoothed(flat, volumes(frame), {plenty, lost});
    ASSERT_EQ(fine.triangles.size(), 4 * coarse.triangles.size());
    const std::vector<Vec> normals = make_surface(fine, 1e-9).normals, before = make_surface(coarse, 1e-9).normals;
    const std::size_t old = coarse.positions.size();
    ASSERT_EQ(coarse.fineness, 1);
    for (std::size_t v = 0; v < fine.positions.size(); ++v) {
      const auto ends = v < old
                            ? std::array<std::uint32_t, 2>{static_cast<std::uint32_t>(v), static_cast<std::uint32_t>(v)}
                            : fine.of_edges[v - old];
      const Vector3 where = (coarse.positions[ends[0]] + coarse.positions[ends[1]]) / 2;
      EXPECT_LT((fine.positions[v] - where).norm(), 1e-5);
      EXPECT_LT((normals[v] - (before[ends[0]] + before[ends[1]]).normalized()).norm(), 1e-3F);
    }
  }
}

TEST(Middle, TheRidgeOfATightFoldIsEven) {
  const Middle sharp = roof(9, 5),
               smooth = smoothed(sharp, std::vector<double>(sharp.triangles.size(), 1e-3), {plenty});
  EXPECT_NEAR(ripple(sharp, 4), 0.5, 1e-12);
  EXPECT_LT(std::abs(ripple(smooth, 4)), 0.1); // 0.12 with control points moved out as elsewhere
}

TEST(Middle, WhatIsFlatStays) {
  const formats::Frame frame = test::flat(4, 0.01);
  const Middle flat = middle_of(frame), smooth = smoothed(flat, volumes(frame), {plenty});
  EXPECT_EQ(smooth.positions, flat.positions);
  EXPECT_EQ(smooth.triangles, flat.triangles);
}

// Half of a tube, with straight and round rims and four corners.
TEST(Middle, RimsAreRoundAndCornersStay) {
  Middle half;
  constexpr std::uint32_t around = 6, along = 3;
  for (std::uint32_t j = 0; j < along; ++j)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const double angle = std::numbers::pi * i / around;
      half.positions.emplace_back(std::cos(angle), std::sin(angle), 0.5 * j);
      half.thickness.push_back(0.01);
    }
  for (std::uint32_t j = 0; j + 1 < along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * (around + 1) + i, b = a + around + 1;
      for (const Corners& t : {Corners{a, a + 1, b}, Corners{a + 1, b + 1, b}}) {
        half.source_triangle.push_back(static_cast<std::uint32_t>(half.triangles.size()));
        half.triangles.push_back(t);
      }
    }
  const Middle smooth = smoothed(half, std::vector<double>(half.triangles.size(), 1e-3), {plenty});
  ASSERT_GT(smooth.triangles.size(), half.triangles.size());
  double lowest = 0, widest = 0;
  for (const Vector3& x : smooth.positions) {
    widest = std::max(widest, std::abs(std::hypot(x.x(), x.y()) - 1));
    lowest = std::max({lowest, -x.z(), x.z() - 1, -x.y()});
  }
  EXPECT_LT(widest, 0.02); // the chords of the coarse tube: 0.034
  EXPECT_LT(lowest, 1e-12);
  for (const std::size_t corner : {std::size_t{0}, std::size_t{around}})
    EXPECT_EQ(smooth.positions[corner], half.positions[corner]);
}

// Three triangles at one edge, as an imported mesh may have.
TEST(Middle, EdgesOfThreeTrianglesStay) {
  Middle fan;
  fan.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0.5}, {-0.5, 0.9, 0.5}, {-0.5, -0.9, 0.5}, {0.2, 1.2, 0.5}};
  fan.thickness.assign(6, 0.01);
  fan.triangles = {{0, 2, 1}, {0, 3, 1}, {0, 4, 1}, {0, 3, 5}};
  fan.source_triangle = {0, 1, 2, 3};
  const Middle smooth = smoothed(fan, std::vector<double>(4, 1e-3), {plenty});
  ASSERT_GT(smooth.triangles.size(), 4u);
  EXPECT_EQ(smooth.positions[0], fan.positions[0]);
  EXPECT_EQ(smooth.positions[1], fan.positions[1]);
  for (const Vector3& x : smooth.positions)
    EXPECT_TRUE(x.allFinite());
}

} // namespace
} // namespace sheet::render
