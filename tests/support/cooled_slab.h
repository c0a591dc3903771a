// SPDX-License-Identifier: GPL-3.0-or-later
// Exact temperatures across slabs [Carslaw and Jaeger 1959, III], and how far profiles of a sheet are from them.
#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/heat_sheets.h"

namespace sheet::heat::test {

// A slab of half thickness 1 and diffusivity 1 that was 1 and whose faces are cooled to 0: Σ over the roots of
// β tan β = Bi.
class CooledSlab {
public:
  explicit CooledSlab(double biot) : biot_(biot) {
    for (int n = 0; n < 60; ++n) {
      double low = n * std::numbers::pi, high = low + std::numbers::pi / 2;
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

// The greatest errors over the time in which the mean falls to a twentieth: of the mean and at the quarter points, over
// what there was to cool (the latter from κ t/(h/2)² = 0.1 on, when the cold has come to the middle); and from then on
// of the mean across of a viscosity that rises e^8 times as it cools, by ThicknessRule and at the quarter points.
struct ProfileErrors {
  double mean = 0, points = 0, viscosity = 0, quarter_viscosity = 0;
};

inline ProfileErrors errors_of(const Profile& profile, double biot) {
  const Sheet sheet = one_triangle(2); // half thickness 1, k = 1, ρ c = 1
  Problem problem = problem_of(sheet, {});
  problem.conductivity = 1;
  problem.profile = profile;
  problem.surroundings = {{{biot, 1000}, {biot, 1000}}};
  Solver solver(sheet.mesh);
  const CooledSlab slab(biot);
  const ThicknessRule rule(profile);
  const double end = 3 * (1 / biot + 1.0 / 3), duration = end / 300;
  Temperatures now{{1001}, std::vector<double>(profile.degrees.size() - 1, 0.0)};
  ProfileErrors errors;
  constexpr int parts = 100; // of half the thickness
  for (int i = 1; i <= 300; ++i) {
    now = step(solver, problem, now, duration);
    const double time = i * duration;
    errors.mean = std::max(errors.mean, std::abs(now.mean[0] - 1000 - slab.mean(time)));
    if (time < 0.1)
      continue;
    const auto viscosity_of = [](double t) { return std::exp(-8 * (t - 1000)); };
    double viscosity = 0, exact_viscosity = 0;
    for (int k = 0; k < parts; ++k)
      exact_viscosity += viscosity_of(1000 + slab.at(time, (k + 0.5) / parts)) / parts;
    for (const double zeta : quarter_points) {
      const double t = temperature_at(profile, now.mean[0], now.modes, zeta);
      errors.points = std::max(errors.points, std::abs(t - 1000 - slab.at(time, 2 * zeta)));
      viscosity += viscosity_of(t) / 4;
    }
    errors.quarter_viscosity = std::max(errors.quarter_viscosity, std::abs(viscosity / exact_viscosity - 1));
    const double by_rule = rule.moments(now.mean[0], now.modes, viscosity_of).zeroth;
    errors.viscosity = std::max(errors.viscosity, std::abs(by_rule / exact_viscosity - 1));
  }
  return errors;
}

// A slab of half thickness 1 and diffusivity 1 between ambients of -1 and 1, at 0 first: x Bi/(1 + Bi) in the end, from
// which the roots of β cot β = -Bi fade.
inline double between(double biot, double time, double x) {
  double sum = x;
  for (int n = 0; n < 60; ++n) {
    double low = n * std::numbers::pi + std::numbers::pi / 2, high = (n + 1) * std::numbers::pi;
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

} // namespace sheet::heat::test
