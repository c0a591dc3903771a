// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of heat for tests, steps of two stages [Alexander 1977] as those of the mechanics, and what is wrong with
// them.
#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "libsheet/heat/stage.h"
#include "tests/support/meshes.h"

namespace sheet::heat::test {

struct Sheet {
  std::shared_ptr<const Connectivity> mesh;
  std::vector<Vector3> centroids, lengths;
  std::vector<double> areas, volumes;

  [[nodiscard]] std::size_t triangles() const { return areas.size(); }
  // Of each triangle, by a function of its centroid.
  template <class Function> [[nodiscard]] std::vector<double> each(Function function) const {
    std::vector<double> all;
    for (const Vector3& x : centroids)
      all.push_back(function(x));
    return all;
  }
  // The root of the mean square of the difference, by area.
  template <class Function> [[nodiscard]] double error(const std::vector<double>& t, Function exact) const {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < triangles(); ++i) {
      sum += areas[i] * std::pow(t[i] - exact(centroids[i]), 2);
      area += areas[i];
    }
    return std::sqrt(sum / area);
  }
};

inline Sheet sheet_of(const sheet::test::Mesh& mesh, double thickness) {
  Sheet sheet{std::make_shared<const Connectivity>(connect(mesh.positions.size(), mesh.triangles)), {}, {}, {}, {}};
  sheet.lengths = squared_lengths_of(*sheet.mesh, mesh.positions);
  for (const Corners& c : mesh.triangles) {
    const Vector3 &a = mesh.positions[c[0]], &b = mesh.positions[c[1]], &d = mesh.positions[c[2]];
    sheet.centroids.emplace_back((a + b + d) / 3);
    sheet.areas.push_back((b - a).cross(d - a).norm() / 2);
    sheet.volumes.push_back(thickness * sheet.areas.back());
  }
  return sheet;
}

// One triangle of area 1/2.
inline Sheet one_triangle(double thickness) {
  return sheet_of({{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)}, {{0, 1, 2}}}, thickness);
}

inline Problem problem_of(const Sheet& sheet, const std::vector<double>& temperatures) {
  Problem problem;
  problem.heat_capacity = 1;
  problem.squared_lengths = sheet.lengths;
  problem.volumes = sheet.volumes;
  problem.temperatures = temperatures;
  return problem;
}

struct Temperatures {
  std::vector<double> mean, modes;
};

// A step from `now`; `problem` says all but durations and temperatures.
inline Temperatures step(Solver& solver, Problem problem, const Temperatures& now, double duration) {
  const double gamma = 1 - 1 / std::numbers::sqrt2, s = (1 - gamma) / gamma;
  const auto predicted = [&](const std::vector<double>& from, const std::vector<double>& to) {
    std::vector<double> all(from.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = from[i] + s * (to[i] - from[i]);
    return all;
  };
  problem.duration = gamma * duration;
  problem.temperatures = now.mean;
  problem.modes = now.modes;
  const Result first = solver.stage(problem);
  const Temperatures middle{predicted(now.mean, first.temperatures),
                            now.modes.empty() ? first.modes : predicted(now.modes, first.modes)};
  problem.temperatures = middle.mean;
  problem.modes = middle.modes;
  Result second = solver.stage(problem);
  return {std::move(second.temperatures), std::move(second.modes)};
}

inline Temperatures steps(const Sheet& sheet, const Problem& problem, Temperatures now, double duration, int count) {
  Solver solver(sheet.mesh);
  for (int i = 0; i < count; ++i)
    now = step(solver, problem, now, duration / count);
  return now;
}

// The error of one stage with sources whose solution is T = 500 + cos πx cos πy on an irregular unit square, a mean
// square: that of space alone.
inline double error_of_a_stage(int cells, double shift, double duration) {
  const sheet::test::Mesh mesh = sheet::test::rectangle(1, 1, cells, cells, shift);
  const Sheet sheet = sheet_of(mesh, 0.1);
  const auto wave = [](const Vector3& x) {
    return std::cos(std::numbers::pi * x.x()) * std::cos(std::numbers::pi * x.y());
  };
  const std::vector<double> before(sheet.triangles(), 500.0);
  std::vector<double> sources;
  for (std::size_t t = 0; t < before.size(); ++t) { // by the rule of edge middles
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += wave((mesh.positions[mesh.triangles[t][i]] + mesh.positions[mesh.triangles[t][(i + 1) % 3]]) / 2) / 3;
    sources.push_back((1 / duration + 2 * std::numbers::pi * std::numbers::pi) * sheet.volumes[t] * sum);
  }
  Problem problem = problem_of(sheet, before);
  problem.conductivity = 1;
  problem.duration = duration;
  problem.sources = sources;
  return sheet.error(Solver(sheet.mesh).stage(problem).temperatures, [&](const Vector3& x) { return 500 + wave(x); });
}

} // namespace sheet::heat::test
