// SPDX-License-Identifier: GPL-3.0-or-later
// The chain rule from squared edge lengths q_k = |e_k|² [m²] of a triangle to its vertices: for W(q) with s = ∂W/∂q and
// C = ∂²W/∂q²,
//   ∂W/∂x = Σ 2 s_k (e_k at its head, -e_k at its tail),   ∂²W/∂x² = Jᵀ C J + 2 Σ s_k (edge Laplacian),   J = ∂q/∂x.
// Edge k runs from vertex k+1 to vertex k+2.
#pragma once
#include "libsheet/geometry/types.h"

namespace sheet {

struct EdgeSprings {
  Vector3 edge[3];

  explicit EdgeSprings(const VectorN<9>& u)
      : edge{u.segment<3>(6) - u.segment<3>(3), u.segment<3>(0) - u.segment<3>(6), u.segment<3>(3) - u.segment<3>(0)} {}

  [[nodiscard]] Vector3 squared_lengths() const {
    return {edge[0].squaredNorm(), edge[1].squaredNorm(), edge[2].squaredNorm()};
  }

  void gradient(const Vector3& s, VectorN<9>& g) const {
    const Vector3 f[3] = {2 * s[0] * edge[0], 2 * s[1] * edge[1], 2 * s[2] * edge[2]};
    g << f[1] - f[2], f[2] - f[0], f[0] - f[1];
  }

  [[nodiscard]] Eigen::Matrix<double, 3, 9> jacobian() const {
    Eigen::Matrix<double, 3, 9> j;
    const Vector3 d[3] = {2 * edge[0], 2 * edge[1], 2 * edge[2]};
    j << 0, 0, 0, -d[0].transpose(), d[0].transpose(), //
        d[1].transpose(), 0, 0, 0, -d[1].transpose(),  //
        -d[2].transpose(), d[2].transpose(), 0, 0, 0;
    return j;
  }

  void hessian(const Matrix3& c, const Vector3& s, MatrixN<9>& h) const {
    const Eigen::Matrix<double, 3, 9> j = jacobian();
    const Eigen::Matrix<double, 3, 9> cj = c.lazyProduct(j);
    h = j.transpose().lazyProduct(cj); // Eigen's general product costs more than this small one
    for (int k = 0; k < 3; ++k) {
      const int tail = 3 * ((k + 1) % 3), head = 3 * ((k + 2) % 3);
      for (int d = 0; d < 3; ++d) {
        h(tail + d, tail + d) += 2 * s[k];
        h(head + d, head + d) += 2 * s[k];
        h(tail + d, head + d) -= 2 * s[k];
        h(head + d, tail + d) -= 2 * s[k];
      }
    }
  }
};

} // namespace sheet
