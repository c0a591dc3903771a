// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric 2x2 forms on a triangle, held as their values on its three edges: m_k = M(e_k, e_k), edge k opposite vertex
// k. The first fundamental form is then the squared edge lengths [m²]; no edge is singled out and no basis chosen.
// With u = e_2 and v = -e_1 as basis: M_uu = m_2, M_vv = m_1, M_uv = (m_1 + m_2 - m_0)/2.
#pragma once
#include <algorithm>
#include <cmath>

#include "libsheet/geometry/types.h"

namespace sheet {

// det M = m1 m2 - (m1 + m2 - m0)²/4 in the basis (u, v).
inline double form_determinant(const Vector3& m) {
  return m[1] * m[2] - 0.25 * (m[1] + m[2] - m[0]) * (m[1] + m[2] - m[0]);
}

inline Vector3 squared_lengths(const Vector3& x0, const Vector3& x1, const Vector3& x2) {
  return {(x2 - x1).squaredNorm(), (x0 - x2).squaredNorm(), (x1 - x0).squaredNorm()};
}

// The inverse of a metric a, ready to raise indices: tr(a⁻¹M) = τ·m and det(a⁻¹M) = det M / det a.
// τ are at the same time the edge values that represent a⁻¹ itself: a⁻¹ = Σ τ_k (e_k ⊗ e_k in coordinates).
struct RaisedMetric {
  Vector3 trace;      // τ [1/m²]
  Vector3 lengths;    // the metric, as squared edge lengths [m²]
  double determinant; // det a [m⁴]; the triangle's area is sqrt(det a)/2

  RaisedMetric() = default;
  explicit RaisedMetric(const Vector3& q) : lengths(q), determinant(form_determinant(q)) {
    const double s = 1 / (2 * determinant);
    trace = {s * (q[1] + q[2] - q[0]), s * (q[2] + q[0] - q[1]), s * (q[0] + q[1] - q[2])};
  }

  [[nodiscard]] double area() const { return 0.5 * std::sqrt(determinant); }

  // C with mᵀ C m = tr(M²) + tr(M)² (mixed components): the dissipation of an incompressible sheet.
  // tr(M²) = tr(M)² - 2 det M.
  [[nodiscard]] Matrix3 dissipation() const {
    Matrix3 c = 2 * trace * trace.transpose();
    const double d = 0.5 / determinant;
    c.diagonal().array() += d;
    c(0, 1) -= d, c(1, 0) -= d, c(0, 2) -= d, c(2, 0) -= d, c(1, 2) -= d, c(2, 1) -= d;
    return c;
  }

  // C m
  [[nodiscard]] Vector3 dissipated(const Vector3& m) const {
    const double d = 0.5 / determinant;
    return (2 * trace.dot(m)) * trace + d * Vector3(m[0] - m[1] - m[2], m[1] - m[2] - m[0], m[2] - m[0] - m[1]);
  }

  // The positive part of a symmetric tensor S = Σ s_k (e_k ⊗ e_k), with respect to this metric, in closed form:
  // with eigenvalues p > 0 > n of S a, S⁺ = p (S - n a⁻¹)/(p - n).
  [[nodiscard]] Vector3 positive_part(const Vector3& s) const {
    const double half = 0.5 * s.dot(lengths);
    const double product = (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) * determinant;
    const double root = std::sqrt(std::max(0.0, half * half - product));
    const double p = half + root, n = half - root;
    if (n >= 0)
      return s;
    if (p <= 0)
      return Vector3::Zero();
    return (p / (p - n)) * (s - n * trace);
  }
};

} // namespace sheet
