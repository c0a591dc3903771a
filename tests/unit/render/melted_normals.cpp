// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/melted_normals.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheet::render {
namespace {

constexpr int points_a_side = 41;
constexpr double grid_cell = 0.05;

// z = steep |x| in cells of 0.05 over [-1, 1]², each triangle with points and normals of its own.
Surface valley(double steep) {
  Surface s;
  const auto at = [&](int i, int j) {
    const double x = grid_cell * (i - points_a_side / 2), y = grid_cell * (j - points_a_side / 2);
    return Vector3(x, y, steep * std::abs(x));
  };
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    const Vec normal = (b - a).cross(c - a).normalized().cast<float>();
    for (const Vector3& x : {a, b, c}) {
      s.source_vertex.push_back(static_cast<std::uint32_t>(s.positions.size()));
      s.positions.push_back(x);
      s.normals.push_back(normal);
    }
    s.triangles.push_back({first, first + 1, first + 2});
  };
  for (int i = 0; i + 1 < points_a_side; ++i)
    for (int j = 0; j + 1 < points_a_side; ++j) {
      add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return s;
}

// Of points within a tenth of these coordinates.
Vec mean_near(const Surface& s, const std::vector<Vec>& normals, double x, double y) {
  Vec sum = Vec::Zero();
  for (std::size_t p = 0; p < normals.size(); ++p)
    if (std::abs(s.positions[p].x() - x) < 0.1 && std::abs(s.positions[p].y() - y) < 0.1)
      sum += normals[p];
  return sum.normalized();
}

constexpr double melt_radius = 0.4, steepness = 0.5;

TEST(MeltedNormals, TurnToTheirMeanAcrossACrease) {
  const Surface s = valley(steepness);
  const std::vector<float> all(s.positions.size(), 1), none(s.positions.size(), 0);
  const std::vector<Vec> melted = melted_normals(s, all, none, melt_radius);
  const Vec left = mean_near(s, melted, -0.15, 0), middle = mean_near(s, melted, 0, 0),
            right = mean_near(s, melted, 0.15, 0), far = mean_near(s, melted, 0.75, 0);
  EXPECT_NEAR(middle.x(), 0, 0.01);
  EXPECT_NEAR(middle.z(), 1, 0.001);
  EXPECT_NEAR(left.x(), -right.x(), 0.02);
  const double own = -steepness / std::hypot(1, steepness);
  EXPECT_GT(right.x(), 0.9 * own); // turned, but
  EXPECT_LT(right.x(), 0.3 * own); // not to the upright
  EXPECT_NEAR(far.x(), own, 1e-5);
  EXPECT_LT((melted[0] - s.normals[0]).norm(), 1e-5); // a plane's stay at its rim, too
  for (const Vec& n : melted)
    EXPECT_NEAR(n.norm(), 1, 1e-5);
}

TEST(MeltedNormals, StayWhereNothingIsCloseAndPassOverWhatIsCovered) {
  const Surface s = valley(steepness);
  const std::vector<float> none(s.positions.size(), 0), all(s.positions.size(), 1);
  EXPECT_EQ(melted_normals(s, none, none, melt_radius), s.normals);
  std::vector<float> left(s.positions.size(), 0);
  for (std::size_t p = 0; p < left.size(); ++p)
    left[p] = s.positions[p].x() < 1e-9 && s.normals[p].x() > 0 ? 1 : 0; // the whole left side
  const std::vector<Vec> melted = melted_normals(s, all, left, melt_radius);
  for (std::size_t p = 0; p < melted.size(); ++p)
    if (left[p] == 0) { // the right side has nothing but itself around it
      EXPECT_LT((melted[p] - s.normals[p]).norm(), 1e-5) << s.positions[p].transpose();
    }
}

} // namespace
} // namespace sheet::render
