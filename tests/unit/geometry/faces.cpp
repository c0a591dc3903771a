// SPDX-License-Identifier: GPL-3.0-or-later
// What rims and slopes add to a sheet's area, against closed forms.
#include "libsheet/geometry/faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/geometry/area.h"

namespace sheet {
namespace {

// Equilateral triangles with edges of 1, a parallelogram of n x n pairs, whose thickness is 1 + slope·x.
struct Layer {
  std::vector<Vector3> x;
  Connectivity mesh;
  std::vector<double> volumes;
  double area = 0;

  Layer(std::uint32_t n, const Vector3& slope) {
    const double height = std::numbers::sqrt3 / 2;
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        x.emplace_back(i + 0.5 * j, height * j, 0);
    std::vector<Corners> triangles;
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
        triangles.push_back({a, a + 1, b});
        triangles.push_back({a + 1, b + 1, b});
      }
    mesh = connect(x.size(), triangles);
    for (const Corners& c : triangles) {
      const double own = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
      volumes.push_back(own * (1 + slope.dot(x[c[0]] + x[c[1]] + x[c[2]]) / 3));
      area += own;
    }
  }
};

TEST(Faces, EvenSlopesCostTheAreaOfBothFaces) {
  constexpr std::uint32_t n = 60;
  for (const Vector3& slope : {Vector3(0.01, 0, 0), Vector3(0, 0.01, 0), Vector3(0.007, -0.007, 0)}) {
    const Layer layer(n, slope);
    FreeFaces faces{std::vector<double>(layer.mesh.edges.size(), 0), {}};
    const double both = slope.squaredNorm() / 4 * layer.area;
    EXPECT_NEAR(extra_area(layer.mesh, layer.x, layer.volumes, faces) / both, 1, 2.0 / n); // without the border's edges
    faces.closed.assign(layer.x.size(), 1); // one face rises by all of it
    EXPECT_NEAR(extra_area(layer.mesh, layer.x, layer.volumes, faces) / (2 * both), 1, 2.0 / n);
    faces.closed.assign(layer.x.size(), 2); // between layers
    EXPECT_EQ(extra_area(layer.mesh, layer.x, layer.volumes, faces), 0);
  }
}

TEST(Faces, RimsAreHalfRoundAndFlatWhereTrianglesResolveTheirRoundness) {
  Layer layer(4, Vector3::Zero());
  const auto of_thickness = [&](double h) {
    for (double& volume : layer.volumes)
      volume = h * std::numbers::sqrt3 / 4;
    return extra_area(layer.mesh, layer.x, layer.volumes, all_free(layer.mesh)) / (16 * h);
  };
  EXPECT_NEAR(of_thickness(1), std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(of_thickness(1e4), 1, 1e-3);
  EXPECT_LT(of_thickness(4), of_thickness(8));
}

// A strip of one row of near to equilateral triangles, π r wide and 2 r thick, whose r is 1 + a cos(k x): its faces and
// rims have the area of the round thread, to second order 2 π r + π r (dr/dx)² a length.
TEST(Faces, AThreadsAreaIsThatOfARoundOne) {
  constexpr double pi = std::numbers::pi, k = 0.1, a = 0.02;
  const double width = pi / 2, half = width / std::numbers::sqrt3;
  const auto cells_along = 2 * static_cast<std::uint32_t>(std::round(2 * pi / k / (2 * half))); // of a whole wave
  const double step = 2 * pi / k / cells_along;
  const auto area_of = [&](double amplitude) {
    const auto r = [&](double x) { return 1 + amplitude * std::cos(k * x); };
    std::vector<Vector3> x;
    std::vector<Corners> triangles;
    for (std::uint32_t i = 0; i <= cells_along; ++i) {
      x.emplace_back(i * step, (i % 2 == 0 ? -0.5 : 0.5) * width * r(i * step), 0);
      if (i >= 2)
        triangles.push_back(i % 2 == 0 ? Corners{i - 2, i, i - 1} : Corners{i - 2, i - 1, i});
    }
    const Connectivity mesh = connect(x.size(), triangles);
    std::vector<double> volumes;
    double area = 0;
    for (const Corners& c : triangles) {
      const double own = TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
      volumes.push_back(own * 2 * r((x[c[0]] + x[c[1]] + x[c[2]]).x() / 3));
      area += 2 * own;
    }
    FreeFaces faces = all_free(mesh);
    for (std::size_t e = 0; e < mesh.edges.size(); ++e) // but the ends
      if (mesh.edges[e][1] - mesh.edges[e][0] == 1)
        faces.rims[e] = 0;
    return area + extra_area(mesh, x, volumes, faces);
  };
  const double slopes = pi * a * a * k * k / 2 * 2 * pi / k;
  EXPECT_NEAR(((area_of(a) + area_of(-a)) / 2 - area_of(0)) / slopes, 1, 0.03);
}

TEST(Faces, EvenThicknessHasSlopesNearRimsOnly) {
  const Layer even(10, Vector3::Zero()), uneven(10, Vector3(0.1, 0.05, 0));
  const auto count = [](const Layer& layer, const FreeFaces& faces) {
    return sloped_edges(layer.mesh, layer.x, layer.volumes, faces, {0.01, 0.01}).size();
  };
  const FreeFaces closed{std::vector<double>(even.mesh.edges.size(), 0), {}};
  const std::size_t inner = even.mesh.edges.size() - 40;
  EXPECT_EQ(count(even, closed), 0U);
  EXPECT_EQ(count(uneven, all_free(even.mesh)), inner);
  EXPECT_GT(count(even, all_free(even.mesh)), 0U);
  EXPECT_LT(count(even, all_free(even.mesh)), inner);
}

// What lies on something counts from other slopes on than what is free, or between two things.
TEST(Faces, SmoothThicknessHasSlopesWhereItLies) {
  const Layer smooth(10, Vector3(0.001, 0.0005, 0));
  const auto count = [&](std::vector<double> on) {
    const FreeFaces faces{std::vector<double>(smooth.mesh.edges.size(), 0), std::move(on)};
    return sloped_edges(smooth.mesh, smooth.x, smooth.volumes, faces, {.free = 0.01, .on_something = 1e-5}).size();
  };
  EXPECT_EQ(count({}), 0U);
  for (const double on : {0.0, 2.0})
    EXPECT_EQ(count(std::vector<double>(smooth.mesh.vertices, on)), 0U);
  EXPECT_EQ(count(std::vector<double>(smooth.mesh.vertices, 1)), smooth.mesh.edges.size() - 40);
}

// With a factor for each triangle: linear in them, and of one that stands alone all of its own.
TEST(Faces, ExtraAreaByFactorsOfTheTriangles) {
  const Layer layer(4, {0.1, 0.05, 0});
  const FreeFaces faces = all_free(layer.mesh);
  const double plain = extra_area(layer.mesh, layer.x, layer.volumes, faces);
  std::vector<double> factors(layer.volumes.size(), 3);
  EXPECT_NEAR(extra_area(layer.mesh, layer.x, layer.volumes, faces, factors), 3 * plain, 1e-13 * plain);
  double sum = 0;
  for (std::size_t t = 0; t < factors.size(); ++t) {
    std::ranges::fill(factors, 0);
    factors[t] = 1;
    const double own = extra_area(layer.mesh, layer.x, layer.volumes, faces, factors);
    EXPECT_GT(own, 0);
    sum += own;
  }
  EXPECT_NEAR(sum, plain, 1e-13 * plain);
}

} // namespace
} // namespace sheet
