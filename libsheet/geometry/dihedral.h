// SPDX-License-Identifier: GPL-3.0-or-later
// The angle [rad] between the normals of two triangles (x0, x1, x2) and (x1, x0, x3) about their edge x0x1, in (-π, π],
// positive where the sheet bends away from its normals (a ridge), with exact first and second derivatives.
// With e = x1-x0, c1 = e × (x2-x0), c2 = (x3-x0) × e, l = |e|: ∂θ/∂x2 = -l c1/|c1|², ∂θ/∂x3 = -l c2/|c2|²; the edge's
// own vertices take what balance of force and torque leaves, in the proportion of the foot points λ [Tamstorf and
// Grinspun 2013 give an equivalent form].
#pragma once
#include <cmath>

#include "libsheet/geometry/types.h"

namespace sheet {

struct Dihedral {
  double angle;
  VectorN<12> gradient;
  MatrixN<12> hessian;
};

inline double dihedral_angle(const Vector3& x0, const Vector3& x1, const Vector3& x2, const Vector3& x3) {
  const Vector3 e = x1 - x0;
  const Vector3 c1 = e.cross(x2 - x0), c2 = (x3 - x0).cross(e);
  return std::atan2(c1.cross(c2).dot(e) / e.norm(), c1.dot(c2));
}

template <bool WithHessian>
inline Dihedral dihedral(const Vector3& x0, const Vector3& x1, const Vector3& x2, const Vector3& x3) {
  Dihedral d;
  const Vector3 e = x1 - x0;
  const Vector3 arm[2] = {x2 - x0, x3 - x0};
  const Vector3 c[2] = {e.cross(arm[0]), arm[1].cross(e)};
  const double l2 = e.squaredNorm(), l = std::sqrt(l2);
  d.angle = std::atan2(c[0].cross(c[1]).dot(e) / l, c[0].dot(c[1]));
  Vector3 force[2], by_e = Vector3::Zero();
  double lambda[2];
  for (int s = 0; s < 2; ++s) {
    force[s] = -(l / c[s].squaredNorm()) * c[s];
    lambda[s] = arm[s].dot(e) / l2;
    by_e -= lambda[s] * force[s];
  }
  // From (e, arm1, arm2) to (x0, x1, x2, x3).
  d.gradient << -(by_e + force[0] + force[1]), by_e, force[0], force[1];
  if constexpr (WithHessian) {
    MatrixN<9> h = MatrixN<9>::Zero();
    for (int s = 0; s < 2; ++s) {
      const double sign = s == 0 ? 1 : -1;
      const double c2 = c[s].squaredNorm();
      const Matrix3 reflect = (l / c2) * (Matrix3::Identity() - (2 / c2) * c[s] * c[s].transpose());
      const Matrix3 force_arm = -sign * reflect * skew(e);
      const Matrix3 force_e = -(c[s] * e.transpose()) / (l * c2) + sign * reflect * skew(arm[s]);
      h.block<3, 3>(3 + 3 * s, 3 + 3 * s) = force_arm;
      h.block<3, 3>(3 + 3 * s, 0) = force_e;
      h.block<3, 3>(0, 3 + 3 * s) = force_e.transpose();
      h.block<3, 3>(0, 0) -= lambda[s] * force_e + force[s] * ((arm[s] - 2 * lambda[s] * e) / l2).transpose();
    }
    // From (e, arm1, arm2) to the vertices: x0 takes minus the sum of the others.
    const auto sum = [](const Matrix3& p, const Matrix3& q, const Matrix3& r) { return Matrix3(-(p + q + r)); };
    d.hessian.block<9, 9>(3, 3) = h;
    for (int a = 0; a < 9; a += 3) {
      d.hessian.block<3, 3>(0, 3 + a) = sum(h.block<3, 3>(0, a), h.block<3, 3>(3, a), h.block<3, 3>(6, a));
      d.hessian.block<3, 3>(3 + a, 0) = d.hessian.block<3, 3>(0, 3 + a).transpose();
    }
    d.hessian.block<3, 3>(0, 0) =
        sum(d.hessian.block<3, 3>(0, 3), d.hessian.block<3, 3>(0, 6), d.hessian.block<3, 3>(0, 9));
  }
  return d;
}

} // namespace sheet
