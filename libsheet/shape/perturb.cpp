// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/perturb.h"

#include <cmath>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/types.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/random.h"

namespace sheet {

namespace {

void check(double amplitude, double wavelength) {
  if (!std::isfinite(amplitude) || !std::isfinite(wavelength) || !(wavelength > 0.0))
    fail(ExitCode::bad_input,
         "perturbation: amplitude = {:g} m must be finite, wavelength = {:g} m positive and finite", amplitude,
         wavelength);
}

Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  if (!(v.stableNorm() > 0.0) || !v.allFinite())
    fail(ExitCode::bad_input, "perturbation: direction [{:g}, {:g}, {:g}] must be finite and not zero", v.x(), v.y(),
         v.z());
  return v.stableNormalized();
}

} // namespace

HeightField plane_wave(double amplitude, double wavelength, const Eigen::Vector3d& direction,
                       const Eigen::Vector3d& origin) {
  check(amplitude, wavelength);
  return [=, along = unit(direction)](const Eigen::Vector3d& x) {
    return amplitude * std::sin(two_pi * (x - origin).dot(along) / wavelength);
  };
}

HeightField radial_wave(double amplitude, double wavelength, const Eigen::Vector3d& axis, const Eigen::Vector3d& center,
                        double start) {
  check(amplitude, wavelength);
  return [=, along = unit(axis)](const Eigen::Vector3d& x) {
    return amplitude * std::sin(two_pi * ((x - center).cross(along).norm() - start) / wavelength);
  };
}

HeightField band_noise(double amplitude, double wavelength, std::uint64_t seed,
                       const std::optional<Eigen::Vector3d>& normal) {
  check(amplitude, wavelength);
  constexpr int waves = 48;
  constexpr double width = 1.25;
  struct Wave {
    Eigen::Vector3d vector; // [rad/m]
    double phase;           // [rad]
  };
  std::vector<Wave> sum;
  Random random(seed);
  const Eigen::Vector3d n = normal ? unit(*normal) : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  for (int i = 0; i < waves; ++i) {
    const double angle = random.uniform(0.0, two_pi);
    const double z = normal ? 0.0 : random.uniform(-1.0, 1.0);
    const double number = two_pi / (wavelength * std::pow(width, random.uniform(-1.0, 1.0)));
    const Eigen::Vector3d direction = std::sqrt(1.0 - z * z) * (std::cos(angle) * u + std::sin(angle) * v) + z * n;
    sum.push_back({number * direction, random.uniform(0.0, two_pi)});
  }
  return [=](const Eigen::Vector3d& x) {
    double value = 0.0;
    for (const Wave& wave : sum)
      value += std::sin(wave.vector.dot(x) + wave.phase);
    return amplitude * value / std::sqrt(static_cast<double>(waves));
  };
}

void displace_along_normals(TriangleMesh& mesh, const HeightField& field) {
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i)
    mesh.positions[i] += field(mesh.positions[i]) * normals[i];
}

void set_thickness(TriangleMesh& mesh, double mean, const HeightField& field) {
  std::vector<double> thickness;
  thickness.reserve(mesh.positions.size());
  for (const Eigen::Vector3d& x : mesh.positions) {
    thickness.push_back(field ? mean + field(x) : mean);
    if (!(thickness.back() > 0.0) || !std::isfinite(thickness.back()))
      fail(ExitCode::bad_input, "thickness = {:g} m at vertex {} must be positive and finite", thickness.back(),
           thickness.size() - 1);
  }
  mesh.vertex_thickness = std::move(thickness);
  mesh.triangle_thickness.clear();
}

} // namespace sheet
