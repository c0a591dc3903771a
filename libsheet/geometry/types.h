// SPDX-License-Identifier: GPL-3.0-or-later
// Short names of the fixed-size dense types that geometry and energies speak in. Nothing here has a unit.
#pragma once
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace sheet {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
template <int N> using VectorN = Eigen::Matrix<double, N, 1>;
template <int N> using MatrixN = Eigen::Matrix<double, N, N>;

// The matrix of the cross product: skew(a) b = a × b.
inline Matrix3 skew(const Vector3& a) {
  Matrix3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

} // namespace sheet
