// SPDX-License-Identifier: GPL-3.0-or-later
// Temperature across the thickness against exact solutions of slabs [Carslaw and Jaeger 1959, III].
#include "libsheet/heat/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "tests/unit/heat/sheets.h"

namespace sheet::heat {
namespace {

using std::numbers::pi;

// A slab of half thickness 1 and diffusivity 1 that was 1 and whose faces are cooled to 0: Σ over the roots of
// β tan β = Bi.
class CooledSlab {
public:
  explicit CooledSlab(double biot) : biot_(biot) {
    for (int n = 0; n < 60; ++n) {
      double low = n * pi, high = low + pi / 2;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (middle * std::tan(middle) < biot ? low : high) = middle;
      }
      roots_.push_back(0.5 * (low + high));
    }
  }
  // At x from -1 to 1.
  [[nodiscard]] double at(double time, double x) const {
    double sum = 0;
    for (const double b : roots_)
      sum += 4 * std::sin(b) / (2 * b + std::sin(2 * b)) * std::cos(b * x) * std::exp(-b * b * time);
    return sum;
  }
  [[nodiscard]] double mean(double time) const {
    double sum = 0;
    for (const double b : roots_)
      sum += 2 * biot_ * biot_ / (b * b * (b * b + biot_ * biot_ + biot_)) * std::exp(-b * b * time);
    return sum;
  }

private:
  double biot_;
  std::vector<double> roots_;
};

// The greatest errors over the time in which the mean falls to a twentieth, of what there was to cool.
struct Errors {
  double mean = 0, points = 0, viscosity = 0;
};

constexpr double steepness = 8; // of ln μ over the range

Errors errors_of(const Profile& profile, double biot) {
  const test::Sheet sheet = test::one_triangle(2); // half thickness 1, k = 1, ρ c = 1
  Problem problem = test::problem_of(sheet, {});
  problem.conductivity = 1;
  problem.profile = profile;
  problem.surroundings = {{{biot, 1000}, {biot, 1000}}};
  Solver solver(sheet.mesh);
  const CooledSlab slab(biot);
  const double end = 3 * (1 / biot + 1.0 / 3), duration = end / 300;
  test::Temperatures now{{1001}, std::vector<double>(profile.degrees.size() - 1, 0.0)};
  Errors errors;
  for (int i = 1; i <= 300; ++i) {
    now = test::step(solver, problem, now, duration);
    const double time = i * duration;
    errors.mean = std::max(errors.mean, std::abs(now.mean[0] - 1000 - slab.mean(time)));
    if (time < 0.1) // before, the cold has not come to the middle
      continue;
    double viscosity = 0, exact_viscosity = 0;
    for (const double zeta : quarter_points) {
      const double t = temperature_at(profile, now.mean[0], now.modes, zeta) - 1000, exact = slab.at(time, 2 * zeta);
      errors.points = std::max(errors.points, std::abs(t - exact));
      viscosity += std::exp(-steepness * t) / 4;
      exact_viscosity += std::exp(-steepness * exact) / 4;
    }
    errors.viscosity = std::max(errors.viscosity, std::abs(viscosity / exact_viscosity - 1));
  }
  return errors;
}

TEST(Profile, OfAParabolaHasTheMeanOfASlab) {
  EXPECT_LT(errors_of(parabola(), 0.3).mean, 0.002);
  EXPECT_LT(errors_of(parabola(), 1).mean, 0.01);
  EXPECT_LT(errors_of(parabola(), 0.3).mean, errors_of(uniform_profile(), 0.3).mean / 20);
}

TEST(Profile, OfThreeModesHasTheTemperaturesOfASlab) {
  for (const double biot : {3.0, 10.0}) {
    const Errors three = errors_of(even_modes(3), biot), five = errors_of(even_modes(5), biot);
    EXPECT_LT(three.mean, 0.005) << biot;
    EXPECT_LT(three.points, 0.004) << biot;
    EXPECT_LT(three.viscosity, 0.04) << biot;
    EXPECT_LT(five.points, 1e-4) << biot;
    EXPECT_LT(five.viscosity, 5e-4) << biot;
  }
}

// A face that is cooled and one that is not are half of a slab of twice the thickness.
TEST(Profile, OfEvenAndOddModesIsThatOfASlabCooledFromOneFace) {
  const double biot = 3;
  const CooledSlab slab(biot);
  const test::Sheet sheet = test::one_triangle(1);
  Problem problem = test::problem_of(sheet, {});
  problem.conductivity = 1;
  problem.profile = all_modes(6);
  problem.surroundings[upper] = {biot, 1000};
  const double time = 0.4;
  const test::Temperatures now = test::steps(sheet, problem, {{1001}, std::vector<double>(5, 0.0)}, time, 200);
  EXPECT_NEAR(now.mean[0], 1000 + slab.mean(time), 1e-4);
  for (const double zeta : quarter_points)
    EXPECT_NEAR(temperature_at(problem.profile, now.mean[0], now.modes, zeta), 1000 + slab.at(time, zeta + 0.5), 2e-4);
}

// Ambients of different temperature: steadily the profile is linear, and what flows is (T_l - T_u)/(1/H_u + h/k +
// 1/H_l).
TEST(Profile, BetweenColdAndWarmIsLinear) {
  const double h = 0.02, k = 0.8, hu = 40, hl = 120, tu = 300, tl = 500;
  const double flux = (tl - tu) / (1 / hu + h / k + 1 / hl), upper_face = tu + flux / hu, lower_face = tl - flux / hl;
  const test::Sheet sheet = test::one_triangle(h);
  const std::vector<double> start = {900};
  for (const Profile& profile : {parabola(), all_modes(2), all_modes(5)}) {
    Problem problem = test::problem_of(sheet, start);
    problem.heat_capacity = 1e6;
    problem.conductivity = k;
    problem.profile = profile;
    problem.duration = 1e10;
    problem.surroundings = {{{hu, tu}, {hl, tl}}};
    const Result result = Solver(sheet.mesh).stage(problem);
    for (const double zeta : {-0.5, -0.1, 0.3, 0.5})
      EXPECT_NEAR(temperature_at(profile, result.temperatures[0], result.modes, zeta),
                  lower_face + (upper_face - lower_face) * (zeta + 0.5), 1e-5);
    EXPECT_NEAR(result.account.faces[upper] / (problem.duration * sheet.areas[0]), flux, 1e-6 * flux);
  }
}

// A slab of half thickness 1 and diffusivity 1 between ambients of -1 and 1, at 0 first: x Bi/(1 + Bi) in the end, from
// which the roots of β cot β = -Bi fade.
double between(double biot, double time, double x) {
  double sum = x;
  for (int n = 0; n < 60; ++n) {
    double low = n * pi + pi / 2, high = (n + 1) * pi;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (middle / std::tan(middle) > -biot ? low : high) = middle;
    }
    const double b = 0.5 * (low + high);
    const double part = (std::sin(b) - b * std::cos(b)) / (b * b) / (0.5 - std::sin(2 * b) / (4 * b));
    sum -= part * std::sin(b * x) * std::exp(-b * b * time);
  }
  return biot / (1 + biot) * sum;
}

TEST(Profile, BetweenColdAndWarmIsThatOfASlab) {
  const test::Sheet sheet = test::one_triangle(2);
  for (const double biot : {0.3, 1.0, 3.0}) {
    const CooledSlab slab(biot);
    const auto error = [&](const Profile& profile, double time) {
      Problem problem = test::problem_of(sheet, {});
      problem.conductivity = 1;
      problem.profile = profile;
      problem.surroundings = {{{biot, 1000.5}, {biot, 999.5}}};
      const std::vector<double> modes(profile.degrees.size() - 1, 0.0);
      const test::Temperatures now = test::steps(sheet, problem, {{1001}, modes}, time, 200);
      double greatest = 0;
      for (const double zeta : quarter_points) {
        const double exact = 1000 + slab.at(time, 2 * zeta) + 0.5 * between(biot, time, 2 * zeta);
        greatest = std::max(greatest, std::abs(temperature_at(profile, now.mean[0], now.modes, zeta) - exact));
      }
      return greatest;
    };
    EXPECT_LT(error(parabola(), 1), 0.012) << biot;
    EXPECT_LT(error(all_modes(8), 0.2), 2e-4) << biot;
  }
}

// T_u = T - (h/k) (q_u/3 - q_l/6), as the head of profile.h says.
TEST(Profile, OfAParabolaHasTheFaceTemperaturesOfItsFluxes) {
  const double h = 0.02, k = 0.8;
  const test::Sheet sheet = test::one_triangle(h);
  const std::vector<double> start = {900};
  Problem problem = test::problem_of(sheet, start);
  problem.heat_capacity = 1e6;
  problem.conductivity = k;
  problem.profile = parabola();
  problem.duration = 10;
  problem.surroundings = {{{40, 300}, {0, 0, 0.8, 1400}}};
  const Result result = Solver(sheet.mesh).stage(problem);
  const double by_area = problem.duration * sheet.areas[0];
  const double qu = result.account.faces[upper] / by_area, ql = result.account.faces[lower] / by_area;
  const double mean = result.temperatures[0];
  const double tu = temperature_at(parabola(), mean, result.modes, 0.5);
  const double tl = temperature_at(parabola(), mean, result.modes, -0.5);
  EXPECT_NEAR(tu, mean - h / k * (qu / 3 - ql / 6), 1e-8);
  EXPECT_NEAR(tl, mean - h / k * (ql / 3 - qu / 6), 1e-8);
  EXPECT_NEAR(qu, 40 * (tu - 300), 1e-7);
  EXPECT_NEAR(ql, problem.surroundings[lower].flux(tl), 1e-7 * std::abs(ql));
}

TEST(Profile, IsMadeOfLegendresPolynomials) {
  EXPECT_DOUBLE_EQ(legendre(2, 0.5), 1);
  EXPECT_DOUBLE_EQ(legendre(3, -0.5), -1);
  EXPECT_DOUBLE_EQ(legendre(2, 0), -0.5);
  const std::vector<double> modes = {2, 4};
  EXPECT_DOUBLE_EQ(temperature_at(all_modes(3), 300, modes, 0.25), 300 + 2 * 0.5 + 4 * (3 * 0.25 - 1) / 2);
  double sum = 0;
  for (const double zeta : quarter_points)
    sum += legendre(2, zeta) / 4;
  EXPECT_NEAR(sum, 0, 1e-15);
  EXPECT_THROW((void)even_modes(0), Error);
  EXPECT_THROW((void)all_modes(most_modes + 1), Error);
}

} // namespace
} // namespace sheet::heat
