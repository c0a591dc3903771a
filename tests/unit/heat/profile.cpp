// SPDX-License-Identifier: GPL-3.0-or-later
// Temperature across the thickness against exact solutions of slabs [Carslaw and Jaeger 1959, III].
#include "libsheet/heat/profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "tests/support/cooled_slab.h"

namespace sheet::heat {
namespace {

TEST(Profile, OfAParabolaHasTheMeanOfASlab) {
  EXPECT_LT(test::errors_of(parabola(), 0.3).mean, 0.002);
  EXPECT_LT(test::errors_of(parabola(), 1).mean, 0.01);
  EXPECT_LT(test::errors_of(parabola(), 0.3).mean, test::errors_of(uniform_profile(), 0.3).mean / 20);
}

TEST(Profile, OfThreeModesHasTheTemperaturesOfASlab) {
  for (const double biot : {3.0, 10.0}) {
    const test::ProfileErrors three = test::errors_of(even_modes(3), biot), five = test::errors_of(even_modes(5), biot);
    EXPECT_LT(three.mean, 0.005) << biot;
    EXPECT_LT(three.points, 0.004) << biot;
    EXPECT_LT(three.viscosity, 0.04) << biot;
    EXPECT_LT(five.points, 1e-4) << biot;
    EXPECT_LT(five.viscosity, 1e-3) << biot;
    EXPECT_GT(five.quarter_viscosity, 0.3) << biot; // why there is a rule of ten points
  }
}

// A face that is cooled and one that is not are half of a slab of twice the thickness.
TEST(Profile, OfEvenAndOddModesIsThatOfASlabCooledFromOneFace) {
  const double biot = 3;
  const test::CooledSlab slab(biot);
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
  const std::vector<double> start = {(upper_face + lower_face) / 2};
  for (const Profile& profile : {parabola(), all_modes(2), all_modes(5)}) {
    Problem problem = test::problem_of(sheet, start);
    problem.heat_capacity = 1e6;
    problem.conductivity = k;
    problem.profile = profile;
    problem.duration = 1e9;
    problem.surroundings = {{{hu, tu}, {hl, tl}}};
    const Result result = Solver(sheet.mesh).stage(problem);
    for (const double zeta : {-0.5, -0.1, 0.3, 0.5})
      EXPECT_NEAR(temperature_at(profile, result.temperatures[0], result.modes, zeta),
                  lower_face + (upper_face - lower_face) * (zeta + 0.5), 1e-5);
    EXPECT_NEAR(result.account.faces[upper] / (problem.duration * sheet.areas[0]), flux, 1e-6 * flux);
  }
}

TEST(Profile, BetweenColdAndWarmIsThatOfASlab) {
  const test::Sheet sheet = test::one_triangle(2);
  for (const double biot : {0.3, 1.0, 3.0}) {
    const test::CooledSlab slab(biot);
    const auto error = [&](const Profile& profile, double time) {
      Problem problem = test::problem_of(sheet, {});
      problem.conductivity = 1;
      problem.profile = profile;
      problem.surroundings = {{{biot, 1000.5}, {biot, 999.5}}};
      const std::vector<double> modes(profile.degrees.size() - 1, 0.0);
      const test::Temperatures now = test::steps(sheet, problem, {{1001}, modes}, time, 200);
      double greatest = 0;
      for (const double zeta : quarter_points) {
        const double exact = 1000 + slab.at(time, 2 * zeta) + 0.5 * test::between(biot, time, 2 * zeta);
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
  EXPECT_NEAR(ql, problem.surroundings[lower].flux(tl), 3e-6 * std::abs(ql));
}

TEST(ThicknessRule, IntegratesWhatDependsOnTemperature) {
  const std::vector<double> modes = {2, 4};
  const ThicknessRule rule(all_modes(3));
  const auto moments = rule.moments(300, modes, [](double t) { return std::exp(0.5 * (t - 300)); });
  double zeroth = 0, first = 0, second = 0;
  constexpr int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double zeta = (i + 0.5) / parts - 0.5;
    const double part = std::exp(0.5 * (temperature_at(all_modes(3), 300, modes, zeta) - 300)) / parts;
    zeroth += part;
    first += part * zeta;
    second += part * zeta * zeta;
  }
  EXPECT_NEAR(moments.zeroth, zeroth, 1e-6 * zeroth);
  EXPECT_NEAR(moments.first, first, 1e-6 * zeroth);
  EXPECT_NEAR(moments.second, second, 1e-6 * zeroth);
  const auto constant = ThicknessRule(uniform_profile()).moments(300, {}, [](double) { return 5.0; });
  EXPECT_NEAR(constant.zeroth, 5, 1e-14);
  EXPECT_NEAR(constant.first, 0, 1e-14);
  EXPECT_NEAR(constant.second, 5.0 / 12, 1e-14);
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
