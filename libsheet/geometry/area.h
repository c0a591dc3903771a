// SPDX-License-Identifier: GPL-3.0-or-later
// Area [m²] of a triangle with exact first and second derivatives.
// c = (x1-x0) × (x2-x0), A = |c|/2, n = c/|c|, e_i the edge opposite vertex i, counter-clockwise:
//   ∂A/∂x_i = n × e_i / 2,   ∂²A/∂x_i∂x_j = (e_i·e_j)/(4A) n nᵀ + (s_ij/2) [n]ₓ,   s_ij = +1, -1, 0 for j = i+2, i+1,
//   i.
// The first part is positive semidefinite (a Gram matrix), the second moves the triangle in its own plane.
#pragma once
#include "libsheet/geometry/types.h"

namespace sheet {

struct TriangleArea {
  Vector3 edge[3];
  Vector3 normal;
  double area;

  TriangleArea(const Vector3& x0, const Vector3& x1, const Vector3& x2) : edge{x2 - x1, x0 - x2, x1 - x0} {
    const Vector3 c = edge[2].cross(-edge[1]);
    const double length = c.norm();
    area = 0.5 * length;
    normal = length > 0 ? Vector3(c / length) : Vector3::Zero();
  }

  [[nodiscard]] Vector3 gradient(int i) const { return 0.5 * normal.cross(edge[i]); }

  // The 9x9 second derivative; in_plane = false leaves the positive part only.
  [[nodiscard]] MatrixN<9> hessian(bool in_plane) const {
    MatrixN<9> h;
    each_second(in_plane, [&](int i, int j, const Matrix3& block) { h.block<3, 3>(3 * i, 3 * j) = block; });
    return h;
  }

  // visit(i, j, ∂²A/∂x_i∂x_j) for all pairs of corners; likewise.
  template <class Visit> void each_second(bool in_plane, Visit&& visit) const {
    const Matrix3 nn = area > 0 ? Matrix3(normal * normal.transpose() / (4 * area)) : Matrix3::Zero();
    const Matrix3 turn = 0.5 * skew(normal);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Matrix3 block = edge[i].dot(edge[j]) * nn;
        if (in_plane && i != j)
          block += (j == (i + 2) % 3 ? turn : Matrix3(-turn));
        visit(i, j, block);
      }
  }
};

} // namespace sheet
