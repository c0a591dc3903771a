// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/intersections.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace sheet {
namespace {

using Eigen::Vector3d;

std::uint64_t count(const std::vector<Vector3d>& x, const std::vector<Corners>& t) {
  return find_intersections(x, t, std::vector<bool>(t.size(), true), 100).count;
}

// The same at every scale, and turned, where coordinates are rounded.
void expect_count(std::uint64_t expected, const std::vector<Vector3d>& x, const std::vector<Corners>& t) {
  for (const double scale : {1.0, 1e-6, 1e3, 1e-30, 1e30}) {
    std::vector<Vector3d> y = x;
    for (Vector3d& p : y)
      p *= scale;
    EXPECT_EQ(count(y, t), expected) << "scale " << scale;
  }
}

TEST(Intersections, ApartAndThrough) {
  const std::vector<Vector3d> floor = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    std::vector<Vector3d> x = floor;
    x.insert(x.end(), {a, b, c});
    return x;
  };
  const std::vector<Corners> both = {{0, 1, 2}, {3, 4, 5}};
  expect_count(0, with({1, 1, 1}, {2, 1, 1}, {1, 2, 1}), both);  // above
  expect_count(1, with({1, 1, 1}, {1, 1, -1}, {2, 2, 1}), both); // through
  expect_count(1, with({1, 1, 0}, {1, 1, 1}, {2, 1, 1}), both);  // touches with a corner
  expect_count(0, with({3, 3, 0}, {4, 3, 0}, {3, 4, 0}), both);  // in the plane, beside
  expect_count(1, with({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), both);  // in the plane, within
  expect_count(1, with({2, 2, 0}, {4, 4, 0}, {2, 4, 0}), both);  // in the plane, touches a side
  expect_count(1, with({4, 0, 0}, {5, 0, 0}, {5, 1, 0}), both);  // a corner at a corner, without sharing the vertex
}

TEST(Intersections, NeighboursAtAVertex) {
  const std::vector<Corners> both = {{0, 1, 2}, {0, 3, 4}};
  const Vector3d o(0, 0, 0), a(4, 0, 0), b(0, 4, 0);
  expect_count(0, {o, a, b, {-1, 0, 0}, {0, -1, 0}}, both);
  expect_count(0, {o, a, b, {1, 1, 1}, {2, 1, 1}}, both);
  expect_count(1, {o, a, b, {1, 1, 1}, {1, 1, -1}}, both); // pierced by the side opposite
  expect_count(1, {o, a, b, {6, 6, 1}, {6, 6, -1}}, both); // reaches through it, beyond its side
  expect_count(1, {o, a, b, {1, 1, 0}, {2, 1, 0}}, both);  // overlap in the plane
  expect_count(1, {o, a, b, {1, 0, 0}, {1, -1, 0}}, both); // sides on one line, in the plane
  expect_count(1, {o, a, b, a, {4, -4, 0}}, both);         // an edge without sharing it
}

TEST(Intersections, NeighboursAtAnEdge) {
  const std::vector<Corners> both = {{0, 1, 2}, {1, 0, 3}};
  const Vector3d a(0, 0, 0), b(4, 0, 0), c(1, 3, 0);
  expect_count(0, {a, b, c, {1, -3, 0}}, both);   // flat
  expect_count(0, {a, b, c, {1, 3, 1e-9}}, both); // folded, but for a hair
  expect_count(1, {a, b, c, {2, 2, 0}}, both);    // folded onto it
  expect_count(0, {a, b, c, {2, 0, 3}}, both);
  expect_count(0, {a, b, c, c}, {{0, 1, 2}, {0, 1, 2}}); // a duplicate is not a pair
}

// A plane grid at a slant, all coordinates rounded: nothing intersects, though nothing is exactly in a plane.
TEST(Intersections, SlantingGrid) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.3, Vector3d::UnitX()) * Eigen::AngleAxisd(0.7, Vector3d::UnitY())).matrix();
  constexpr std::uint32_t n = 30;
  std::vector<Vector3d> x;
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      x.push_back(turn * Vector3d(0.1 * i, 0.1 * j, 0) + Vector3d(10, -3, 5));
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      const std::uint32_t a = i * n + j;
      t.push_back({a, a + n, a + 1});
      t.push_back({a + 1, a + n, a + n + 1});
    }
  expect_count(0, x, t);
  x[n * n / 2 + n / 2] += turn * Vector3d(0.25, 0, 0); // pulled over its neighbours in the plane
  EXPECT_GT(count(x, t), 0);
}

// Against all pairs, by another method: two triangles without common vertices intersect if a side of one meets the
// other; on integer coordinates, with the signs of determinants in exact 64-bit arithmetic.
using Integer = std::array<std::int64_t, 3>;
int side(const Integer& a, const Integer& b, const Integer& c, const Integer& d) {
  std::int64_t m[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    m[0][i] = b[i] - a[i];
    m[1][i] = c[i] - a[i];
    m[2][i] = d[i] - a[i];
  }
  const std::int64_t det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return (det > 0) - (det < 0);
}
// In general position only: nothing if a determinant vanishes.
std::optional<bool> pierces(const Integer& p, const Integer& q, const std::array<Integer, 3>& t) {
  const int above = side(t[0], t[1], t[2], p), below = side(t[0], t[1], t[2], q);
  const int s0 = side(p, q, t[0], t[1]), s1 = side(p, q, t[1], t[2]), s2 = side(p, q, t[2], t[0]);
  if (above * below * s0 * s1 * s2 == 0)
    return {};
  return above != below && s0 == s1 && s1 == s2;
}

TEST(Intersections, RandomSoupAgainstAllPairs) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> coordinate(-1000, 1000), offset(-200, 200);
  std::vector<std::array<Integer, 3>> soup(400);
  for (auto& triangle : soup) {
    const Integer center = {coordinate(random), coordinate(random), coordinate(random)};
    for (Integer& corner : triangle)
      for (std::size_t i = 0; i < 3; ++i)
        corner[i] = center[i] + offset(random);
  }
  for (const double scale : {1.0, 1e-9, 1e6}) {
    std::vector<Vector3d> x;
    std::vector<Corners> t;
    for (const auto& triangle : soup) {
      const auto first = static_cast<std::uint32_t>(x.size());
      t.push_back({first, first + 1, first + 2});
      for (const Integer& c : triangle)
        x.push_back(scale * Vector3d(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])));
    }
    const Intersections found = find_intersections(x, t, std::vector<bool>(t.size(), true), 100000);
    std::size_t expected = 0, unclear = 0;
    for (std::uint64_t i = 0; i < soup.size(); ++i)
      for (std::uint64_t j = i + 1; j < soup.size(); ++j) {
        bool meet = false, clear = true;
        for (std::size_t k = 0; k < 3; ++k)
          for (const auto& [one, other] : {std::pair{i, j}, std::pair{j, i}}) {
            const auto answer = pierces(soup[one][k], soup[one][(k + 1) % 3], soup[other]);
            clear &= answer.has_value();
            meet |= answer.value_or(false);
          }
        if (!clear) {
          ++unclear;
          continue;
        }
        expected += meet ? 1 : 0;
        EXPECT_EQ(std::binary_search(found.pairs.begin(), found.pairs.end(), std::pair{i, j}), meet) << i << " " << j;
      }
    EXPECT_GT(expected, 50);
    EXPECT_LT(unclear, 10);
    EXPECT_EQ(found.count, found.pairs.size());
  }
}

TEST(Intersections, LimitKeepsTheFirst) {
  std::vector<Vector3d> x;
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 40; ++i) { // all through one another
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    const double angle = 0.05 * i;
    x.insert(x.end(), {{0, 0, -1 - 0.01 * i}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0}});
  }
  const std::vector<bool> usable(t.size(), true);
  const auto all = find_intersections(x, t, usable, 1000), few = find_intersections(x, t, usable, 3);
  EXPECT_EQ(all.count, 40 * 39 / 2);
  EXPECT_EQ(few.count, all.count);
  ASSERT_EQ(few.pairs.size(), 3);
  EXPECT_TRUE(std::equal(few.pairs.begin(), few.pairs.end(), all.pairs.begin()));
}

TEST(Degenerate, ExactlyOnALine) {
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {3, 3, 3.0000000000000004}, {3, 3, 3}};
  const std::vector<Corners> t = {{0, 1, 2}, {0, 1, 3}, {0, 2, 4}};
  EXPECT_EQ(find_degenerate(x, t, {true, true, true}), (std::vector<std::uint64_t>{0, 2}));
  EXPECT_EQ(find_degenerate(x, t, {true, true, false}), (std::vector<std::uint64_t>{0}));
}

} // namespace
} // namespace sheet
