// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/buckling.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "libsheet/material/shifted_liquid.h"

namespace sheet::remesh {

namespace {

constexpr double over_rate = 5;       // growth over the rate at which the sheet deforms
constexpr double of_fastest = 0.25;   // growth over that of the fastest part of the sheet,
constexpr double fastest_part = 0.05; // of its area

// Root mean square over the sheet of the velocity gradient G, less the rotation Ω of the whole that makes it least,
// which is that of the mean antisymmetric part where the sheet lies all around, so that a turning frame changes nothing
// that matters: |G - Ω P|², P the projection onto the triangle's plane.
double rate_scale(const std::vector<TriangleRates>& rates) {
  Matrix3 left = Matrix3::Zero();
  Vector3 right = Vector3::Zero();
  double area = 0;
  const auto plane = [](const TriangleShape& s) {
    return Matrix3(Matrix3::Identity() - s.normal * s.normal.transpose());
  };
  // Ω P = Σ ω_i L_i P with (L_i)_jk = -ε_ijk
  const auto turn = [](int i) { return skew(Vector3::Unit(i)); };
  for (const TriangleRates& r : rates) {
    area += r.shape.area;
    const Matrix3 p = plane(r.shape);
    for (int i = 0; i < 3; ++i) {
      right[i] += r.shape.area * (turn(i) * p).cwiseProduct(r.velocity).sum();
      for (int k = 0; k < 3; ++k)
        left(i, k) += r.shape.area * (turn(i) * p).cwiseProduct(turn(k) * p).sum();
    }
  }
  const Vector3 spin = left.ldlt().solve(right);
  double sum = 0;
  for (const TriangleRates& r : rates)
    sum += r.shape.area * (r.velocity - skew(spin) * plane(r.shape)).squaredNorm();
  return area > 0 ? std::sqrt(sum / area) : 0;
}

double least_eigenvalue(const Matrix3& m) {
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0];
}

struct Wave {
  double number = 0, growth = 0; // [1/m], [1/s]
};

Wave fastest_wave(const Scene& scene, const Liquid& liquid, const ShiftedCurve& flow, const TriangleRates& r) {
  const StrainRate rate = strain_rate(r.stretching);
  const double viscosity = flow.viscosity(rate);
  const double h = r.thickness, modulus = flow.tangent_viscosity(rate) * h * h * h / 3;
  const double stretching = least_eigenvalue(r.stretching) + r.stretching.trace();
  const double load = -2 * viscosity * h * stretching -
                      2 * (r.temperature > 0 ? liquid.surface_tension_at(r.temperature) : liquid.surface_tension);
  Wave fastest;
  if (!(load > 0 && modulus > 0 && scene.model.bending))
    return fastest;
  const auto consider = [&](double k, double growth) {
    if (growth > fastest.growth)
      fastest = {k, growth};
  };
  const auto& gravity = scene.environment.gravity;
  if (scene.environment.bath && gravity) {
    const double weight = scene.environment.bath->density * gravity->norm();
    consider(std::sqrt(2 * weight / load), load * load / (4 * modulus * weight));
  }
  if (scene.model.inertia) {
    const double k = std::pow(liquid.density * h * load / (2 * modulus * modulus), 1.0 / 6);
    consider(k, load / (2 * modulus * k * k));
  }
  return fastest;
}

// The growth that is exceeded in `fastest_part` of the area.
double fast_growth(const std::vector<Wave>& waves, const std::vector<TriangleRates>& rates) {
  std::vector<std::pair<double, double>> growth_area;
  double left = 0;
  for (std::size_t t = 0; t < waves.size(); ++t) {
    growth_area.emplace_back(waves[t].growth, rates[t].shape.area);
    left += fastest_part * rates[t].shape.area;
  }
  std::sort(growth_area.begin(), growth_area.end(), std::greater<>());
  for (const auto& [growth, area] : growth_area)
    if ((left -= area) < 0)
      return growth;
  return 0;
}

} // namespace

std::vector<double> buckling_wavenumbers(const Scene& scene, const std::vector<TriangleRates>& rates) {
  const std::vector<Liquid> liquids = scene::liquids_of(scene);
  std::vector<FlowCurve> flows;
  std::vector<ViscosityShift> shifts;
  for (const Liquid& liquid : liquids) {
    flows.emplace_back(liquid);
    shifts.emplace_back(liquid.temperature_law);
  }
  std::vector<Wave> waves;
  for (const TriangleRates& r : rates) {
    const double shift = r.temperature > 0 ? shifts[r.liquid].factor(r.temperature) : 1;
    waves.push_back(fastest_wave(scene, liquids[r.liquid], {flows[r.liquid], shift}, r));
  }
  const double least = std::max(over_rate * rate_scale(rates), of_fastest * fast_growth(waves, rates));
  std::vector<double> numbers;
  for (const Wave& wave : waves)
    numbers.push_back(wave.growth > least ? wave.number : 0);
  return numbers;
}

} // namespace sheet::remesh
