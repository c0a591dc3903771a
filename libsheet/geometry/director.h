// SPDX-License-Identifier: GPL-3.0-or-later
// Mid-edge directors: unit vectors perpendicular to their edges, shared by the two triangles of an edge, and the second
// fundamental form that they give a triangle [Grinspun et al. 2006]. A director is the start-of-step one, carried by
// the smallest rotation that takes the start direction t0 of the edge to the present one t [Bergou et al. 2010], then
// turned about the edge by an angle θ [rad]:
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
  // The angle by which n, perpendicular to the edge or nearly so, is turned from the director.
  [[nodiscard]] double angle_to(const Vector3& n) const { return std::atan2(n.dot(binormal), n.dot(director)); }
  // The director over the edge direction t (unit).
  [[nodiscard]] Vector3 carried(double theta, const Vector3& t) const {
    const Vector3 q = turned(theta);
    return q - (t.dot(q) / (1 + tangent.dot(t))) * (tangent + t);
  }
};

// A director n over the direction t of its edge, and n' = ∂n/∂θ, so that of edge i with w = m_i - x_i the height is g =
// n·w [m], and its side c = n'·w, by which it changes if n turns: with α the angle from the triangle's normal to n, g =
// |w| sin α and c = ±|w| cos α for w across the edge.
struct CarriedDirector {
  Vector3 director, beside;

  CarriedDirector() = default;
  CarriedDirector(const EdgeFrame& frame, const Vector3& t, double theta) {
    const double cosine = std::cos(theta), sine = std::sin(theta), k = 1 / (1 + frame.tangent.dot(t));
    const Vector3 s = frame.tangent + t;
    const Vector3 q = cosine * frame.director + sine * frame.binormal,
                  r = cosine * frame.binormal - sine * frame.director;
    director = q - (k * t.dot(q)) * s;
    beside = r - (k * t.dot(r)) * s;
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
    // Projections across the edge; the derivative of t by e is the projection over the length.
    const Vector3& t0 = frame.tangent;
    const Vector3 q1 = q - tq * t, w1 = w - t.dot(w) * t, t1 = t0 - t0.dot(t) * t;
    const Vector3 p1 = sw * q1 + tq * w1;
    const double c = k * k * tq * sw;
    const Vector3 across = c * t1 - k * p1;
    const Vector3 dq = cosine * frame.binormal - sine * frame.director; // ∂q/∂θ
    const double tdq = t.dot(dq);
    g.by_e = inverse * across;
    g.by_w = q - (k * tq) * s;
    g.by_theta = dq.dot(w) - k * tdq * sw;
    if constexpr (Order >= 2) {
      // With f(t) the value as a function of the direction, ∂²f/∂t² = -k (q wᵀ + w qᵀ) + (r t0ᵀ + t0 rᵀ), projected,
      // less what the curvature of the sphere of directions adds.
      const double along = c * t0.dot(t) - k * tq * (sw + t.dot(w)); // t·∂f/∂t
      const Vector3 r = (k * k) * p1 - (k * c) * t1, z = (0.5 * along) * t - across;
      const Vector3 left = inverse * ((k * k * tq) * t1 - k * q1), kq = -k * q1;
      const double squared = inverse * inverse, ktq = inverse * k * tq;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const double symmetric =
              kq[i] * w1[j] + w1[i] * kq[j] + r[i] * t1[j] + t1[i] * r[j] + z[i] * t[j] + t[i] * z[j];
          g.ee(i, j) = squared * (symmetric - (i == j ? along : 0));
          // ∂²f/∂t∂w = -k (q sᵀ + (t·q) I) + k² (t·q) t0 sᵀ, projected on the left
          g.ew(i, j) = left[i] * s[j] - ktq * ((i == j ? 1 : 0) - t[i] * t[j]);
        }
      g.e_theta = inverse * ((k * k * tdq * sw) * t1 - k * (sw * (dq - tdq * t) + tdq * w1));
      g.w_theta = dq - (k * tdq) * s;
    }
  }
  return g;
}

} // namespace sheet
