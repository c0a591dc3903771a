// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/perturb.h"
#include "libsheet/shape/place.h"
#include "libsheet/shape/shapes.h"

namespace sheet {
namespace {

TEST(Place, PlanesAreRotationsWithTheirNormals) {
  EXPECT_EQ(plane_rotation(parse_plane("xy")) * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(plane_rotation(parse_plane("xz")) * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  EXPECT_EQ(plane_rotation(parse_plane("yz")) * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
  EXPECT_THROW((void)parse_plane("zx"), Error);
  TriangleMesh mesh = make_rectangle(2.0, 1.0, {Pattern::structured, 0.0, 1, {{2, 2}}});
  place_mesh(mesh, {Plane::xz, Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()).matrix(), {0, 3, 0}});
  for (const Eigen::Vector3d& n : vertex_normals(mesh))
    EXPECT_NEAR((n - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-15);
  for (const Eigen::Vector3d& x : mesh.positions) {
    EXPECT_EQ(x.y(), 3.0);
    EXPECT_LE(std::abs(x.x()), 0.5 + 1e-15); // turned by a quarter
  }
  EXPECT_THROW(place_mesh(mesh, {Plane::xz, -Eigen::Matrix3d::Identity(), {0, 0, 0}}), Error);
}

TEST(Perturb, WaveAlongAnAxisAndFromTheCentre) {
  const double amplitude = 1e-3, inner = 0.10, outer = 0.25;
  TriangleMesh mesh = make_annulus(inner, outer, {Pattern::irregular, 0.01, 1, {}});
  const std::vector<Eigen::Vector3d> flat = mesh.positions;
  displace_along_normals(mesh, radial_wave(amplitude, (outer - inner) / 2, Eigen::Vector3d::UnitZ(), {0, 0, 0}, inner));
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double s = (flat[i].norm() - inner) / (outer - inner);
    EXPECT_NEAR(mesh.positions[i].z(), amplitude * std::sin(4 * std::numbers::pi * s), 1e-15);
  }
  const HeightField wave = plane_wave(2.0, 4.0, {0, 3, 0});
  EXPECT_NEAR(wave({5, 1, 7}), 2.0, 1e-15);
  EXPECT_THROW((void)plane_wave(1.0, 0.0, {1, 0, 0}), Error);
  EXPECT_THROW((void)plane_wave(1.0, 1.0, {0, 0, 0}), Error);
}

TEST(Perturb, NoiseHasItsStrengthAndItsSeed) {
  const double amplitude = 3.0;
  const HeightField noise = band_noise(amplitude, 0.1, 5, Eigen::Vector3d::UnitZ());
  double mean = 0.0, square = 0.0;
  constexpr int n = 200;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double value = noise({0.02 * i, 0.02 * j, 0.0});
      mean += value / (n * n);
      square += value * value / (n * n);
    }
  EXPECT_NEAR(mean, 0.0, 0.03 * amplitude);
  EXPECT_NEAR(std::sqrt(square), amplitude / std::sqrt(2.0), 0.1 * amplitude);
  EXPECT_EQ(noise({1, 2, 3}), band_noise(amplitude, 0.1, 5, Eigen::Vector3d::UnitZ())({1, 2, 3}));
  EXPECT_NE(noise({1, 2, 3}), band_noise(amplitude, 0.1, 6, Eigen::Vector3d::UnitZ())({1, 2, 3}));
}

TEST(Perturb, ThicknessMustStayPositive) {
  TriangleMesh mesh = make_rectangle(1.0, 1.0, {Pattern::structured, 0.1, 1, {}});
  set_thickness(mesh, 0.02);
  EXPECT_EQ(mesh.vertex_thickness.size(), mesh.positions.size());
  EXPECT_THROW(set_thickness(mesh, 0.02, plane_wave(0.03, 0.5, {1, 0, 0})), Error);
  EXPECT_THROW(set_thickness(mesh, std::nan("")), Error);
}

} // namespace
} // namespace sheet
