// SPDX-License-Identifier: GPL-3.0-or-later
// Mid-edge directors: unit vectors perpendicular to their edges, shared by the two triangles of an edge, and the second
// fundamental form that they give a triangle [Grinspun et al. 2006].
// A director is the start-of-step one (mean of the face normals), carried by the smallest rotation that takes the start
// direction t0 of the edge to the present one t [Bergou et al. 2010], then turned about the edge by an angle θ [rad]:
//   n = q - (t·q)/(1 + t0·t) (t0 + t),   q = cosθ d + sinθ (t0 × d).
// For edge i opposite vertex i, with midpoint m_i, the height g_i = n_i·(m_i - x_i) [m] gives the second form b; on the
// edges b(e_k, e_k) = -2 (g_i + g_j) [m], {i, j, k} the three corners (curvature is positive where the sheet bends
// towards its normals).
#pragma once
#include <cmath>

#include "libsheet/geometry/types.h"

namespace sheet {

struct EdgeFrame {
  Vector3 tangent;  // t0, unit, from the edge's lower to its higher vertex
  Vector3 director; // d, unit, perpendicular to t0
  Vector3 binormal; // t0 × d

  [[nodiscard]] Vector3 turned(double theta) const { return std::cos(theta) * director + std::sin(theta) * binormal; }
  // The director over the edge direction t (unit).
  [[nodiscard]] Vector3 carried(double theta, const Vector3& t) const {
    const Vector3 q = turned(theta);
    return q - (t.dot(q) / (1 + tangent.dot(t))) * (tangent + t);
  }
};

// Value, gradient and second derivative of g = n·w in terms of e = x_high - x_low, w = (x_low + x_high)/2 - x_apex, θ.
struct DirectorHeight {
  double value;
  Vector3 by_e, by_w; // by_w is the director itself
  double by_theta;
  Matrix3 ee, ew; // ew(i, j) = ∂²g/∂e_i∂w_j; ∂²g/∂w² = 0 and ∂²g/∂θ² = -g
  Vector3 e_theta, w_theta;
};

// Orders: 0 value, 1 gradient, 2 second derivatives.
template <int Order>
inline DirectorHeight director_height(const EdgeFrame& frame, const Vector3& e, const Vector3& w, double theta) {
  DirectorHeight g;
  const double length = e.norm(), inverse = 1 / length;
  const Vector3 t = e * inverse;
  const double cosine = std::cos(theta), sine = std::sin(theta);
  const Vector3 q = cosine * frame.director + sine * frame.binormal;
  const Vector3 s = frame.tangent + t;
  const double k = 1 / (1 + frame.tangent.dot(t));
  const double tq = t.dot(q), sw = s.dot(w);
  g.value = q.dot(w) - k * tq * sw;
  if constexpr (Order >= 1) {
    const Vector3 p = sw * q + tq * w;
    const Vector3 by_t = -k * p + (k * k * tq * sw) * frame.tangent;
    const double along = by_t.dot(t);
    const Vector3 across = by_t - along * t;
    const Vector3 dq = cosine * frame.binormal - sine * frame.director; // ∂q/∂θ
    const double tdq = t.dot(dq);
    g.by_e = inverse * across;
    g.by_w = q - (k * tq) * s;
    g.by_theta = dq.dot(w) - k * tdq * sw;
    if constexpr (Order >= 2) {
      const Vector3& t0 = frame.tangent;
      Matrix3 tt = -k * (q * w.transpose() + w * q.transpose()) + (k * k) * (p * t0.transpose() + t0 * p.transpose());
      tt -= (2 * k * k * k * tq * sw) * (t0 * t0.transpose());
      const Matrix3 project = Matrix3::Identity() - t * t.transpose();
      const Vector3 tt_t = tt * t;
      // project * tt * project, without the two matrix products
      Matrix3 inner = tt - tt_t * t.transpose() - t * tt_t.transpose() + t.dot(tt_t) * (t * t.transpose());
      inner -= along * project + across * t.transpose() + t * across.transpose();
      g.ee = (inverse * inverse) * inner;
      // ∂²f/∂t∂w = -k (q sᵀ + (t·q) I) + k² (t·q) t0 sᵀ, then the derivative of t by e on the left
      const Vector3 left = -k * q + (k * k * tq) * t0;
      g.ew = inverse * ((left - t.dot(left) * t) * s.transpose() - (k * tq) * project);
      const Vector3 dp = sw * dq + tdq * w;
      const Vector3 t_theta = -k * dp + (k * k * tdq * sw) * t0;
      g.e_theta = inverse * (t_theta - t.dot(t_theta) * t);
      g.w_theta = dq - (k * tdq) * s;
    }
  }
  return g;
}

} // namespace sheet
