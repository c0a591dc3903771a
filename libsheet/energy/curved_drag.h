// SPDX-License-Identifier: GPL-3.0-or-later
// What slides along something by the way s and is dragged by a liquid that is not Newtonian: the force is k s, with k a
// function of |s| and ∂k/∂s = k' s. Where the liquid thins, Newton's Hessian has a force p of its own, as the stress in
// mid_edge_shell.h: in ∂(k s) = k + k' s sᵀ the second s becomes p/k once, and a direction δ takes p to
// k (s + δ) + (k'/k) (s·δ) p.
#pragma once
#include "libsheet/geometry/types.h"

namespace sheet {

struct CurvedDrag {
  double potential = 0; // [J]
  double stiffness = 0; // k [N/m]
  double change = 0;    // k' [N/m³]

  // ∂(k s) along the slide, with p if there is one.
  [[nodiscard]] Matrix3 hessian(const Vector3& s, const Matrix3& along, const Vector3* p) const {
    const Vector3 other = p != nullptr && change < 0 ? shortened(*p / stiffness, s) : s;
    return stiffness * along + 0.5 * change * (s * other.transpose() + other * s.transpose());
  }
  [[nodiscard]] Vector3 followed(const Vector3& s, const Vector3& step, const Vector3* p) const {
    const Vector3 from = p != nullptr ? *p : Vector3(stiffness * s);
    return stiffness * (s + step) + change / stiffness * s.dot(step) * from;
  }

private:
  // No longer than leaves the Hessian positive semidefinite.
  [[nodiscard]] Vector3 shortened(const Vector3& other, const Vector3& s) const {
    const double over = -change * s.norm() * other.norm();
    return over > stiffness ? Vector3(stiffness / over * other) : other;
  }
};

} // namespace sheet
