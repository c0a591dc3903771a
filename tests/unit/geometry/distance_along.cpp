// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/distance_along.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace sheet {
namespace {

constexpr std::uint32_t columns = 24, rows = 12;

// Unit squares cut into triangles, inner vertices moved at random; without the squares of column `gap`, from row `from`
// on.
struct Grid {
  std::vector<Vector3> x;
  Connectivity mesh;

  explicit Grid(double shift, std::uint32_t gap = columns, std::uint32_t from = 0) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-shift, shift);
    for (std::uint32_t j = 0; j <= rows; ++j)
      for (std::uint32_t i = 0; i <= columns; ++i) {
        const bool inner = i > 0 && i < columns && j > 0 && j < rows;
        x.emplace_back(i + (inner ? uniform(random) : 0), j + (inner ? uniform(random) : 0), 0);
      }
    std::vector<Corners> triangles;
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i)
        if (i != gap || j < from) {
          triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
          triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    mesh = connect(x.size(), triangles);
  }
  static std::uint32_t at(std::uint32_t i, std::uint32_t j) { return j * (columns + 1) + i; }
  // Rolled up isometrically; its corners lie on the roll.
  void roll(double radius) {
    for (Vector3& p : x)
      p = {radius * std::sin(p.x() / radius), p.y(), radius * (1 - std::cos(p.x() / radius))};
  }
};

// By halving; infinite if it is more than 100.
double distance(const Grid& grid, const MeshPoint& from, const MeshPoint& to) {
  const DistanceAlong along(grid.mesh);
  double low = 0, high = 100;
  if (!along.within(grid.x, from, to, high))
    return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 50; ++i)
    (along.within(grid.x, from, to, 0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return high;
}

// From the middle of a triangle in the third column to a vertex.
double to_vertex(const Grid& grid, std::uint32_t vertex) {
  const std::array corners = {Grid::at(2, 5), Grid::at(3, 5), Grid::at(2, 6)}, to = {vertex, vertex, vertex};
  const Vector3 middle = (grid.x[corners[0]] + grid.x[corners[1]] + grid.x[corners[2]]) / 3;
  return distance(grid, {corners, middle}, {std::span(to).first(1), grid.x[vertex]});
}

TEST(DistanceAlong, IsThatOfThePlaneWhereTheMeshIsFlat) {
  for (const double shift : {0.0, 0.3}) {
    const Grid grid(shift);
    const std::array corners = {Grid::at(2, 5), Grid::at(3, 5), Grid::at(2, 6)};
    const Vector3 middle = (grid.x[corners[0]] + grid.x[corners[1]] + grid.x[corners[2]]) / 3;
    for (std::uint32_t v = 0; v < grid.x.size(); ++v) {
      const double exact = (grid.x[v] - middle).norm(), found = to_vertex(grid, v);
      EXPECT_GT(found, exact * (1 - 1e-6)) << v;
      EXPECT_LT(found, exact + 0.125) << v; // asked at its own limit
    }
  }
}

TEST(DistanceAlong, OfPlacesOnEdges) {
  const Grid grid(0.3);
  const std::array one = {Grid::at(4, 6), Grid::at(5, 6)}, two = {Grid::at(9, 3), Grid::at(9, 4)};
  const Vector3 a = 0.3 * grid.x[one[0]] + 0.7 * grid.x[one[1]], b = 0.6 * grid.x[two[0]] + 0.4 * grid.x[two[1]];
  EXPECT_NEAR(distance(grid, {one, a}, {two, b}), (b - a).norm(), 0.01);
  EXPECT_NEAR(distance(grid, {two, b}, {one, a}), (b - a).norm(), 0.01);
}

TEST(DistanceAlong, StaysWhereASheetIsRolledUp) {
  for (const double shift : {0.0, 0.3})
    for (const double radius : {20.0, 5.0, 2.0}) {
      const Grid flat(shift);
      Grid rolled = flat;
      rolled.roll(radius);
      const double chord = 2 * radius / std::sin(1 / (2 * radius)); // edges are chords of arcs of length 1
      for (const std::uint32_t v : {Grid::at(8, 5), Grid::at(12, 5), Grid::at(14, 8), Grid::at(20, 3)})
        EXPECT_NEAR(to_vertex(rolled, v) / to_vertex(flat, v), 1, radius == 2.0 ? 0.06 : 0.02)
            << shift << ", " << radius << ", " << v << ", " << chord;
    }
}

TEST(DistanceAlong, GoesRoundASlitAndNotAcrossAGap) {
  const Grid slit(0, 9, 3); // from row 3 to the rim
  const double direct = 20 - 7.0 / 3, round = to_vertex(slit, Grid::at(20, 6));
  EXPECT_GT(round, 1.05 * direct);
  const Vector3 middle(7.0 / 3, 16.0 / 3, 0), tip(9, 3, 0), other(10, 3, 0), end(20, 6, 0);
  EXPECT_NEAR(round, (tip - middle).norm() + 1 + (end - other).norm(), 0.02 * round);
  EXPECT_TRUE(std::isinf(to_vertex(Grid(0, 9, 0), Grid::at(20, 6))));
}

} // namespace
} // namespace sheet
