// SPDX-License-Identifier: GPL-3.0-or-later
// Conductances of triangles against the mass matrix they are the inverse of, and conduction on irregular and curved
// meshes against closed forms.
#include "libsheet/heat/conduction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "libsheet/geometry/metric.h"
#include "tests/support/heat_sheets.h"
#include "tests/unit/heat/order.h"

namespace sheet::heat {
namespace {

using std::numbers::pi;

const std::array<std::array<Vector3, 3>, 3> triangles = {{{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(.4, .8, 0)},
                                                          {Vector3(0, 0, 0), Vector3(3, 0, 0), Vector3(2.9, .2, 0)},
                                                          {Vector3(1, 2, 0), Vector3(1, 2.1, 0), Vector3(.5, 0, 0)}}};

// Edge middles are the points of a rule that is exact for the products of fluxes.
Matrix3 mass_matrix(const std::array<Vector3, 3>& x, double area) {
  Matrix3 m = Matrix3::Zero();
  for (int point = 0; point < 3; ++point) {
    const Vector3 at = (x[(point + 1) % 3] + x[(point + 2) % 3]) / 2;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        m(i, j) += area / 3 * (at - x[i]).dot(at - x[j]) / (4 * area * area);
  }
  return m;
}

TEST(Conductances, AreTheInverseOfTheMassMatrixOfFluxes) {
  for (const auto& x : triangles) {
    const double area = (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2, h = 0.3, k = 1.7;
    const Conductances own(squared_lengths(x[0], x[1], x[2]), h * area, k);
    const double t = 3;
    const Vector3 edges(1, -2, 5);
    const Vector3 expected = k * h * mass_matrix(x, area).inverse() * (Vector3::Constant(t) - edges);
    EXPECT_LT((own.fluxes(own.exchange * (t - edges.mean()), edges) - expected).norm(), 1e-11 * expected.norm());
  }
}

TEST(Conductances, OfALinearTemperatureAreItsFluxes) {
  const Vector3 gradient(2, -3, 0);
  for (const auto& x : triangles) {
    const double area = (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2, h = 0.3, k = 1.7;
    const Conductances own(squared_lengths(x[0], x[1], x[2]), h * area, k);
    Vector3 edges, expected;
    for (int i = 0; i < 3; ++i) {
      const Vector3 &a = x[(i + 1) % 3], &b = x[(i + 2) % 3];
      edges[i] = 300 + gradient.dot(a + b) / 2;
      expected[i] = -k * h * gradient.dot((b - a).cross(Vector3::UnitZ()));
    }
    const double middle = 300 + gradient.dot(x[0] + x[1] + x[2]) / 3;
    EXPECT_LT((own.fluxes(own.exchange * (middle - edges.mean()), edges) - expected).norm(), 1e-10);
    EXPECT_EQ(own.fluxes(0, Vector3::Constant(300)), Vector3::Zero());
  }
}

TEST(Conductances, OfSliversAreBounded) {
  const Vector3 line(1, 4, 1), point(0, 0, 0);
  const Conductances of_line(line, 1e-12, 1), of_point(point, 1e-12, 1);
  const double h = 1e-12 / (6 * 1e-4);
  EXPECT_LE(of_line.off[1], 1.01 * h / (6 * 1e-4));
  EXPECT_GT(of_line.exchange, 0);
  EXPECT_EQ(of_point.exchange, 0);
  EXPECT_EQ(of_point.off[0], 0);
}

TEST(Conduction, IsOfSecondOrderOnIrregularMeshes) {
  for (const double shift : {0.0, 0.15, 0.3})
    for (const double duration : {10.0, 0.05, 0.001}) {
      const double coarse = test::error_of_a_stage(16, shift, duration),
                   middle = test::error_of_a_stage(32, shift, duration),
                   fine = test::error_of_a_stage(64, shift, duration);
      EXPECT_GT(std::log2(coarse / middle), 1.8) << shift << ' ' << duration << ' ' << coarse << ' ' << middle;
      EXPECT_GT(std::log2(middle / fine), 1.8) << shift << ' ' << duration << ' ' << middle << ' ' << fine;
    }
}

// J_0(r) of a disk without flux at its rim, r = 3.8317 there [Carslaw and Jaeger 1959].
TEST(Conduction, LetsAModeOfADiskDecay) {
  const double root = 3.8317059702075123, rate = root * root, duration = 0.1;
  double before = 0;
  for (const int rings : {6, 12, 24}) {
    const test::Sheet sheet = test::sheet_of(sheet::test::disk(1, rings, 0.2), 0.01);
    const auto mode = [&](const Vector3& x) { return std::cyl_bessel_j(0, root * x.head<2>().norm()); };
    Problem problem = test::problem_of(sheet, {});
    problem.conductivity = 1;
    const std::vector<double> start = sheet.each([&](const Vector3& x) { return 400 + mode(x); });
    const std::vector<double> end = test::steps(sheet, problem, {start, {}}, duration, 40).mean;
    const double decay = std::exp(-rate * duration);
    const double error = sheet.error(end, [&](const Vector3& x) { return 400 + decay * mode(x); }) / decay;
    test::expect_order(before, error, 1.8);
  }
  EXPECT_LT(before, 5e-3);
}

// A spherical harmonic of degree l falls as exp(-l (l + 1) κ t/R²).
TEST(Conduction, LetsAHarmonicOfASphereDecay) {
  const double duration = 0.1;
  double before = 0;
  for (const int level : {2, 3, 4}) {
    const test::Sheet sheet = test::sheet_of(sheet::test::icosphere(level), 0.01);
    const auto harmonic = [](const Vector3& x) {
      const Vector3 n = x.normalized();
      return n.x() * n.y() + 1.5 * n.z() * n.z() - 0.5;
    };
    Problem problem = test::problem_of(sheet, {});
    problem.conductivity = 1;
    const std::vector<double> start = sheet.each([&](const Vector3& x) { return 400 + harmonic(x); });
    const std::vector<double> end = test::steps(sheet, problem, {start, {}}, duration, 40).mean;
    const double decay = std::exp(-6 * duration);
    const double error = sheet.error(end, [&](const Vector3& x) { return 400 + decay * harmonic(x); }) / decay;
    test::expect_order(before, error, 1.8);
  }
  EXPECT_LT(before, 2e-3);
}

// Hot and cold halves: what goes beyond them is small, whether steps are short or long.
TEST(Conduction, KeepsToTheTemperaturesThereWere) {
  const test::Sheet sheet = test::sheet_of(sheet::test::rectangle(1, 1, 30, 30, 0.25), 0.01);
  const std::vector<double> start = sheet.each([](const Vector3& x) { return x.x() < 0.5 ? 300.0 : 400.0; });
  for (const double duration : {1e-6, 1e-5, 3e-5, 1e-4, 1e-3, 1e-2, 1.0, 1e4})
    for (const int count : {1, 10}) {
      Problem problem = test::problem_of(sheet, {});
      problem.conductivity = 1;
      Solver solver(sheet.mesh);
      std::vector<double> now = start;
      for (int i = 0; i < count; ++i) {
        problem.duration = duration;
        problem.temperatures = now;
        now = solver.stage(problem).temperatures;
      }
      const auto [low, high] = std::ranges::minmax(now);
      EXPECT_GT(low, 300 - 2) << duration;
      EXPECT_LT(high, 400 + 2) << duration;
    }
}

} // namespace
} // namespace sheet::heat
