// SPDX-License-Identifier: GPL-3.0-or-later
// Stages of heat: what leaves through faces and to walls against closed forms, orders in time, and that no heat is
// lost.
#include "libsheet/heat/stage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "libsheet/base/error.h"
#include "tests/support/heat_sheets.h"
#include "tests/unit/heat/order.h"

namespace sheet::heat {
namespace {

// All there is at once, on a sheet that is warm at one end.
struct Everything {
  test::Sheet sheet;
  std::vector<double> start = sheet.each([](const Vector3& x) { return 700 + 400 * x.x(); });
  std::vector<double> sources = sheet.each([](const Vector3& x) { return x.y() > 0.7 ? 3.0 : 0.0; });
  std::vector<double> below = sheet.each([](const Vector3& x) { return x.x() > 0.5 ? 0.0 : 1.0; });
  std::vector<WallContact> contacts;
  Problem problem = test::problem_of(sheet, start);

  explicit Everything(int cells = 24) : sheet(test::sheet_of(sheet::test::rectangle(1, 1, cells, cells, 0.25), 0.02)) {
    for (std::uint32_t t = 0; t < sheet.triangles(); ++t)
      if (below[t] == 0)
        contacts.push_back({t, lower, sheet.centroids[t].y() > 0.5 ? 1U : 0U, 300 * sheet.areas[t], 350});
    problem.heat_capacity = 2.5e6;
    problem.conductivity = 1.2;
    problem.duration = 20;
    problem.sources = sources;
    problem.exposed[lower] = below;
    problem.contacts = contacts;
    problem.walls = 2;
    problem.surroundings = {{{25, 300, 0.9, 310}, {10, 400, 0.5, 500}}};
  }
};

TEST(Stage, LosesNoHeat) {
  Everything all;
  for (const Profile& profile : {uniform_profile(), parabola(), even_modes(3), all_modes(4)})
    for (const double conductivity : {0.0, 1.2, 200.0})
      for (const double duration : {1e-3, 20.0, 1e6}) {
        all.problem.profile = profile;
        all.problem.conductivity = conductivity;
        all.problem.duration = duration;
        const Result result = Solver(all.sheet.mesh).stage(all.problem);
        const Account& account = result.account;
        const double lost = account.faces[upper] + account.faces[lower] + account.walls[0] + account.walls[1];
        double heat = 0, moved = std::abs(account.generated) + std::abs(account.stored);
        for (std::size_t t = 0; t < all.start.size(); ++t)
          heat += all.problem.heat_capacity * all.sheet.volumes[t] * result.temperatures[t];
        for (const double part : {account.faces[upper], account.faces[lower], account.walls[0], account.walls[1]})
          moved += std::abs(part);
        EXPECT_NEAR(account.stored, account.generated - lost, 1e-14 * (heat + moved))
            << conductivity << ' ' << duration;
        EXPECT_LT(result.iterations, 8);
        EXPECT_GT(*std::ranges::min_element(result.temperatures), 290);
      }
}

TEST(Stage, ConservesHeatThatOnlySpreads) {
  const test::Sheet sheet = test::sheet_of(sheet::test::icosphere(4), 0.01);
  const std::vector<double> start = sheet.each([](const Vector3& x) { return x.z() > 0.3 ? 1500.0 : 300.0; });
  long double before = 0;
  for (std::size_t t = 0; t < start.size(); ++t)
    before += sheet.volumes[t] * start[t];
  for (const double duration : {1e-4, 1.0, 1e6}) {
    Problem problem = test::problem_of(sheet, start);
    problem.conductivity = 1;
    problem.duration = duration;
    const Result result = Solver(sheet.mesh).stage(problem);
    long double after = 0;
    for (std::size_t t = 0; t < start.size(); ++t)
      after += sheet.volumes[t] * result.temperatures[t];
    EXPECT_LT(std::abs(static_cast<double>(after / before - 1)), 1e-15) << duration;
    if (duration == 1e6) {
      const double volume = std::accumulate(sheet.volumes.begin(), sheet.volumes.end(), 0.0);
      const double mean = static_cast<double>(before) / volume;
      for (const double t : result.temperatures)
        EXPECT_NEAR(t, mean, 1e-2);
    }
  }
}

// T - T_a falls as exp(-2 H t/(ρ c h)) [lumped].
TEST(Stage, CoolsExponentially) {
  const test::Sheet sheet = test::one_triangle(0.01);
  Problem problem = test::problem_of(sheet, {});
  problem.heat_capacity = 2e6;
  problem.surroundings = {{{30, 300}, {30, 300}}};
  const double duration = 400, exact = 300 + 700 * std::exp(-2 * 30 * duration / (2e6 * 0.01));
  double before = 0;
  for (const int count : {8, 16, 32}) {
    const double error = std::abs(test::steps(sheet, problem, {{1000}, {}}, duration, count).mean[0] - exact);
    test::expect_order(before, error, 1.95);
  }
  EXPECT_LT(before, 1e-3 * 700);
}

// ln((T + T_a)/(T - T_a)) + 2 atan(T/T_a) grows by 8 ε σ T_a³ t/(ρ c h): a sheet that radiates from both faces.
TEST(Stage, RadiatesAsTheClosedForm) {
  const double ambient = 300, capacity = 2e6, h = 0.005, emissivity = 0.85;
  const auto phase = [&](double t) { return std::log((t + ambient) / (t - ambient)) + 2 * std::atan(t / ambient); };
  const test::Sheet sheet = test::one_triangle(h);
  Problem problem = test::problem_of(sheet, {});
  problem.heat_capacity = capacity;
  problem.surroundings = {{{0, 0, emissivity, ambient}, {0, 0, emissivity, ambient}}};
  const double duration = 600;
  double before = 0;
  for (const int count : {16, 32, 64, 128}) {
    const double end = test::steps(sheet, problem, {{1400}, {}}, duration, count).mean[0];
    const double passed =
        (phase(end) - phase(1400)) * capacity * h / (8 * emissivity * stefan_boltzmann * ambient * ambient * ambient);
    const double error = std::abs(passed / duration - 1);
    test::expect_order(before, error, 1.85);
  }
  EXPECT_LT(before, 3e-4);
}

TEST(Stage, SolvesRadiationFast) {
  const test::Sheet sheet = test::one_triangle(0.001);
  const std::vector<double> start = {3000};
  Problem problem = test::problem_of(sheet, start);
  problem.heat_capacity = 1e6;
  problem.duration = 1e9; // as good as steady
  problem.surroundings = {{{0, 0, 1, 300}, {0, 0, 1, 300}}};
  const Result result = Solver(sheet.mesh).stage(problem);
  EXPECT_NEAR(result.temperatures[0], 300, 1e-3);
  EXPECT_LE(result.iterations, 14);
  problem.duration = 1;
  EXPECT_LE(Solver(sheet.mesh).stage(problem).iterations, 8);
  // What the second of two long stages starts from may be below zero.
  const std::vector<double> extrapolated = {-900};
  problem.temperatures = extrapolated;
  problem.duration = 1e4;
  problem.surroundings = {{{0, 0, 1, 1200}, {0, 0, 1, 1200}}};
  const Result heated = Solver(sheet.mesh).stage(problem);
  EXPECT_LE(heated.iterations, 10);
  EXPECT_NEAR(heated.account.stored, -heated.account.faces[upper] - heated.account.faces[lower], 1e-9);
  EXPECT_NEAR(heated.temperatures[0], 1199.7320437558, 1e-3); // ρ c h (T + 900)/τ = 2 σ (1200⁴ - T⁴)
}

TEST(Stage, HasTheDerivativesOfItsFluxes) {
  const Surroundings around{12, 310, 0.7, 450};
  for (const double t : {-300.0, 200.0, 450.0, 1300.0})
    EXPECT_NEAR((around.flux(t + 1e-3) - around.flux(t - 1e-3)) / 2e-3, around.slope(t), 1e-6 * around.slope(t));
  EXPECT_NEAR(around.flux(900), 12 * 590 + 0.7 * stefan_boltzmann * (std::pow(900, 4) - std::pow(450, 4)), 1e-8);
}

TEST(Stage, WithHeatingIsOfSecondOrderInTime) {
  Everything all;
  all.problem.profile = parabola();
  std::vector<double> exact = test::steps(all.sheet, all.problem, {all.start, {}}, 600, 128).mean;
  double before = 0;
  for (const int count : {4, 8, 16}) {
    const std::vector<double> end = test::steps(all.sheet, all.problem, {all.start, {}}, 600, count).mean;
    double error = 0;
    for (std::size_t t = 0; t < end.size(); ++t)
      error = std::max(error, std::abs(end[t] - exact[t]));
    test::expect_order(before, error, 1.9);
  }
}

// Viscous heating with the viscosity at the temperature that is foretold: T0 + τ Ṫ0, with the rate of the last stage,
// then T0 + (T1 - T0)/α. μ = μ0 exp(-b (T - T0)), μ0 = ρ c = b = 1.
double heated(double (*power)(double viscosity), double duration, int count) {
  const double alpha = 1 - 1 / std::numbers::sqrt2, s = (1 - alpha) / alpha, stage = alpha * duration / count;
  const double cold = 300;
  const test::Sheet sheet = test::one_triangle(0.01);
  Solver solver(sheet.mesh);
  const auto stage_from = [&](double reference, double foretold) {
    const std::vector<double> start = {reference}, sources = {sheet.volumes[0] * power(std::exp(cold - foretold))};
    Problem problem = test::problem_of(sheet, start);
    problem.duration = stage;
    problem.sources = sources;
    return solver.stage(problem).temperatures[0];
  };
  double t = cold, rate = 0;
  for (int i = 0; i < count; ++i) {
    const double first = stage_from(t, t + stage * rate), reference = t + s * (first - t);
    const double second = stage_from(reference, t + (first - t) / alpha);
    rate = (second - reference) / stage;
    t = second;
  }
  return t - cold;
}

// Under a stress σ it runs away, exp(-b (T - T0)) = 1 - b σ² t/(ρ c μ0); at a rate γ̇ it slows, exp(b (T - T0)) =
// 1 + b μ0 γ̇² t/(ρ c).
TEST(Stage, HeatsViscouslyToSecondOrder) {
  double by_stress = 0, by_rate = 0;
  for (const int count : {32, 64, 128, 256}) {
    const double stressed = heated([](double viscosity) { return 1 / viscosity; }, 0.8, count);
    test::expect_order(by_stress, std::abs(stressed + std::log(1 - 0.8)), 1.85);
    const double sheared = heated([](double viscosity) { return viscosity; }, 2, count);
    test::expect_order(by_rate, std::abs(sheared - std::log(3)), 1.85);
  }
  EXPECT_LT(by_stress, 1e-3);
  EXPECT_LT(by_rate, 1e-4);
}

TEST(Stage, HasTheSameBitsForAnyNumberOfThreads) {
  Everything all(80);
  all.problem.profile = all_modes(3);
  std::vector<Result> results;
  for (const std::size_t threads : {1, 2, 3, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(Solver(all.sheet.mesh).stage(all.problem));
    EXPECT_EQ(results.back().temperatures, results.front().temperatures);
    EXPECT_EQ(results.back().modes, results.front().modes);
    EXPECT_EQ(results.back().account.walls, results.front().account.walls);
  }
  Solver kept(all.sheet.mesh);
  (void)kept.stage(all.problem);
  EXPECT_EQ(kept.stage(all.problem).temperatures, results.front().temperatures);
}

// Walls take the area that touches them, and the account says which took what.
TEST(Stage, GivesHeatToTheWallsItTouches) {
  const test::Sheet sheet = test::one_triangle(0.01);
  const std::vector<double> start = {500}, none = {0};
  const std::vector<WallContact> contacts = {{0, lower, 2, 40, 320}, {0, lower, 0, 60, 300}};
  Problem problem = test::problem_of(sheet, start);
  problem.heat_capacity = 1e4;
  problem.duration = 1;
  problem.contacts = contacts;
  problem.walls = 3;
  problem.surroundings = {{{}, {1e9, 0}}};
  problem.exposed[lower] = none;
  const Result result = Solver(sheet.mesh).stage(problem);
  const double c = 1e4 * 0.005, expected = (c * 500 + 40 * 320 + 60 * 300) / (c + 100);
  EXPECT_NEAR(result.temperatures[0], expected, 1e-11);
  EXPECT_NEAR(result.account.walls[2], 40 * (expected - 320), 1e-9);
  EXPECT_NEAR(result.account.walls[0], 60 * (expected - 300), 1e-9);
  EXPECT_EQ(result.account.walls[1], 0);
  EXPECT_EQ(result.account.faces[lower], 0);
}

TEST(Stage, EnduresDegenerateTriangles) {
  sheet::test::Mesh mesh = sheet::test::rectangle(1, 1, 8, 8, 0.2);
  mesh.positions[40] = mesh.positions[41];                      // two triangles are lines
  mesh.positions[48] = mesh.positions[49] = mesh.positions[58]; // one is a point
  mesh.positions[20] += 0.999 * (mesh.positions[21] - mesh.positions[20]);
  test::Sheet sheet = test::sheet_of(mesh, 0.01);
  for (double& volume : sheet.volumes)
    volume = std::max(volume, 1e-9);
  const std::vector<double> start = sheet.each([](const Vector3& x) { return 300 + 100 * x.x(); });
  Problem problem = test::problem_of(sheet, start);
  problem.conductivity = 1;
  problem.surroundings[upper] = {1e-3, 300, 0.5, 300};
  for (const Profile& profile : {uniform_profile(), parabola(), all_modes(3)})
    for (const double duration : {1e-6, 1e-2, 1e3}) {
      problem.profile = profile;
      problem.duration = duration;
      const Result result = Solver(sheet.mesh).stage(problem);
      for (const double t : result.temperatures)
        EXPECT_TRUE(t > 299 && t < 401) << duration << ' ' << t;
      for (const double mode : result.modes)
        EXPECT_LT(std::abs(mode), 5) << duration;
      const double left = result.account.stored + result.account.faces[upper] + result.account.faces[lower];
      EXPECT_NEAR(left, 0, 1e-12 * 300 * 0.01);
    }
}

TEST(Stage, RefusesWhatIsNotFinite) {
  const test::Sheet sheet = test::one_triangle(0.01);
  const std::vector<double> start = {500}, none = {0}, unknown = {std::numeric_limits<double>::quiet_NaN()};
  Problem problem = test::problem_of(sheet, start);
  problem.duration = 1;
  problem.sources = unknown;
  EXPECT_THROW((void)Solver(sheet.mesh).stage(problem), Error);
  problem.conductivity = 1;
  EXPECT_THROW((void)Solver(sheet.mesh).stage(problem), Error);
  problem.sources = {};
  problem.volumes = none;
  EXPECT_THROW((void)Solver(sheet.mesh).stage(problem), Error);
}

// Thick, and radiating differently from both faces.
TEST(Stage, SaysWhatToDoWhereAParabolaDoesNotConverge) {
  const test::Sheet sheet = test::one_triangle(1);
  const std::vector<double> start = {2000}, modes = {0, 0};
  Problem problem = test::problem_of(sheet, start);
  problem.heat_capacity = 3e6;
  problem.conductivity = 0.5;
  problem.duration = 10;
  problem.surroundings = {{{0, 0, 0.9, 293}, {0, 0, 0.9, 1420}}};
  problem.profile = parabola();
  try {
    (void)Solver(sheet.mesh).stage(problem);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("profile = 3 in [heat]"), std::string::npos) << error.what();
  }
  problem.profile = all_modes(3);
  problem.modes = modes;
  EXPECT_NO_THROW((void)Solver(sheet.mesh).stage(problem));
}

TEST(Stage, WantsArraysOfTheRightSize) {
  const test::Sheet sheet = test::one_triangle(0.01);
  const std::vector<double> start = {500, 500};
  Problem problem = test::problem_of(sheet, start);
  problem.duration = 1;
  EXPECT_THROW((void)Solver(sheet.mesh).stage(problem), std::logic_error);
  problem.temperatures = std::span(start).first(1);
  EXPECT_EQ(Solver(sheet.mesh).stage(problem).temperatures[0], 500);
  const std::vector<WallContact> uncounted = {{0, lower, 1, 40, 320}};
  problem.contacts = uncounted;
  problem.walls = 1;
  EXPECT_THROW((void)Solver(sheet.mesh).stage(problem), std::logic_error);
}

} // namespace
} // namespace sheet::heat
