// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of a potential W(A) that falls with the area A of a triangle: slope = -dW/dA > 0 [N/m] and curvature
// = d²W/dA² > 0 [N/m³]. The positive form leaves out the part with A's own second derivatives, whose sign is open.
#pragma once
#include "libsheet/geometry/area.h"

namespace sheet {

inline void falls_with_area(const TriangleArea& a, double slope, double curvature, VectorN<9>& gradient,
                            MatrixN<9>& hessian, bool definite) {
  gradient << a.gradient(0), a.gradient(1), a.gradient(2);
  hessian = curvature * gradient * gradient.transpose();
  if (!definite)
    hessian -= slope * a.hessian(true);
  gradient *= -slope;
}

} // namespace sheet
