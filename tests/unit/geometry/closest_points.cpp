// SPDX-License-Identifier: GPL-3.0-or-later
// No pair of points of the two features is nearer than the closest points, and these are points of the features.
#include "libsheet/geometry/closest_points.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sheet {
namespace {

using Points = std::array<Vector3, 4>;

// Small integers make parallel edges, degenerate triangles, and points upon each other.
Points random_points(std::mt19937_64& random, bool integers) {
  std::uniform_real_distribution<double> uniform(-2, 2);
  Points x;
  for (Vector3& p : x)
    for (int k = 0; k < 3; ++k)
      p[k] = integers ? std::round(uniform(random)) : uniform(random);
  return x;
}

void expect_weights(const ClosestPoints& c, const Points& x, std::size_t first) {
  double a = 0, b = 0;
  Vector3 offset = Vector3::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    (i < first ? a : b) += c.weights[i];
    EXPECT_GE(c.weights[i] * (i < first ? 1 : -1), -1e-15);
    offset += c.weights[i] * x[i];
  }
  EXPECT_NEAR(a, 1, 1e-14);
  EXPECT_NEAR(b, -1, 1e-14);
  EXPECT_LT((offset - c.offset).norm(), 1e-14);
}

TEST(ClosestPoints, VertexTriangle) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 4000; ++i) {
    const Points x = random_points(random, i % 2 == 0);
    const ClosestPoints c = closest_vertex_triangle(x);
    expect_weights(c, x, 1);
    double least = 1e9;
    for (int s = 0; s <= 20; ++s)
      for (int t = 0; s + t <= 20; ++t)
        least = std::min(least, (x[0] - ((20 - s - t) * x[1] + s * x[2] + t * x[3]) / 20).norm());
    EXPECT_LE(c.offset.norm(), least + 1e-12);
    if (const auto over = over_triangle(x)) {
      EXPECT_NEAR(over->offset.dot(x[2] - x[1]), 0, 1e-10);
      EXPECT_NEAR(over->offset.dot(x[3] - x[1]), 0, 1e-10);
    }
  }
}

TEST(ClosestPoints, EdgeEdge) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 4000; ++i) {
    const Points x = random_points(random, i % 2 == 0);
    const ClosestPoints c = closest_edge_edge(x);
    expect_weights(c, x, 2);
    double least = 1e9;
    for (int s = 0; s <= 20; ++s)
      for (int t = 0; t <= 20; ++t)
        least = std::min(least, (((20 - s) * x[0] + s * x[1]) / 20 - ((20 - t) * x[2] + t * x[3]) / 20).norm());
    EXPECT_LE(c.offset.norm(), least + 1e-12);
    if (const auto crossing = crossing_edges(x)) {
      EXPECT_NEAR(crossing->offset.dot(x[1] - x[0]), 0, 1e-10);
      EXPECT_NEAR(crossing->offset.dot(x[3] - x[2]), 0, 1e-10);
    }
  }
}

TEST(ClosestPoints, WhatMayBeIsWhereverItIs) {
  std::mt19937_64 random(3);
  int over = 0, crossing = 0, may_be_over = 0, may_be_crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const Points x = random_points(random, i % 2 == 0);
    const bool may_over = may_be_over_triangle(x[0], x[1], x[2], x[3]), may = may_cross(x[0], x[1], x[2], x[3]);
    if (over_triangle(x)) {
      EXPECT_TRUE(may_over);
      ++over;
    }
    if (crossing_edges(x)) {
      EXPECT_TRUE(may);
      ++crossing;
    }
    may_be_over += may_over;
    may_be_crossing += may;
  }
  EXPECT_GT(over, 1000);
  EXPECT_GT(crossing, 1000);
  EXPECT_LT(may_be_over, 5 * over); // a quarter of the plane around a corner, at most
  EXPECT_LT(may_be_crossing, crossing + 10);
}

TEST(ClosestPoints, KnownDistances) {
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_NEAR(closest_vertex_triangle({Vector3(0.2, 0.2, 3), a, b, c}).offset.norm(), 3, 1e-15);
  EXPECT_NEAR(closest_vertex_triangle({Vector3(1, 1, 0), a, b, c}).offset.norm(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(closest_vertex_triangle({Vector3(-3, -4, 0), a, b, c}).offset.norm(), 5, 1e-15);
  EXPECT_NEAR(closest_edge_edge({a, b, Vector3(0, 2, 0), Vector3(1, 2, 0)}).offset.norm(), 2, 1e-15); // parallel
  EXPECT_NEAR(closest_edge_edge({a, b, Vector3(0.5, -1, 2), Vector3(0.5, 1, 2)}).offset.norm(), 2, 1e-15);
  // far from the origin no digits are lost
  const Vector3 far(1e6, -1e6, 1e6);
  EXPECT_NEAR(closest_vertex_triangle({far + Vector3(0.25, 0.25, 0.5), far, far + b, far + c}).offset.norm(), 0.5,
              1e-15);
}

} // namespace
} // namespace sheet
