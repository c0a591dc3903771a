// SPDX-License-Identifier: GPL-3.0-or-later
// Short names of the types that geometry and energies speak in. Nothing here has a unit.
#pragma once
#include <array>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sheet {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Corners = std::array<std::uint32_t, 3>; // vertices of a triangle, counter-clockwise from its positive side
inline constexpr std::uint32_t no_index = 0xffffffffU; // in place of that of a vertex, an edge, a triangle

inline constexpr double two_pi = 2 * std::numbers::pi;

template <int N> using VectorN = Eigen::Matrix<double, N, 1>;
template <int N> using MatrixN = Eigen::Matrix<double, N, N>;

// The matrix of the cross product: skew(a) b = a × b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

} // namespace sheet
