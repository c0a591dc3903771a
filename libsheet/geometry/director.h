// SPDX-License-Identifier: GPL-3.0-or-later
// Mid-edge directors: unit vectors perpendicular to their edges, shared by the two triangles of an edge, and the second
// fundamental form that they give a triangle [Grinspun et al. 2006]. A director is the start-of-step one, carried by
// the smallest rotation that takes the start direction t0 of the edge to the present one t [Bergou et al. 2010], then
// turned about the edge by an angle θ [rad]:
//   n = q - (t·q)/(1 + t0·t) (t0 + t),   q = cosθ d + sinθ (t0 × d).
// For edge i opposite vertex i, with midpoint m_i, the height g_i = n_i·(m_i - x_i) [m] gives the second form b; on the
// edges b(e_k, e_k) = -2 (g_i + g_j) [m], {i, j, k} the three corners (curvature is positive where the sheet bends
// towards its normals). With w = m_i - x_i and n' = ∂n/∂θ, c_i = n'·w [m] is the height's side, by which it changes if
// the director turns: with α the angle from the triangle's normal to n, g = |w| sin α and c = ±|w| cos α for w across
// the edge.
#pragma once
#include <cmath>

#include "libsheet/geometry/types.h"

namespace sheet {

struct EdgeFrame {
  Vector3 tangent;  // t0, unit, from the edge's lower to its higher vertex
  Vector3 director; // d, unit, perpendicular to t0
  Vector3 binormal; // t0 × d

  // The angle by which n, perpendicular to the edge or nearly so, is turned from the director.
  [[nodiscard]] double angle_to(const Vector3& n) const { return std::atan2(n.dot(binormal), n.dot(director)); }
  // The director over the edge direction t (unit); turned by the angle of this sine and cosine.
  [[nodiscard]] Vector3 carried(const Vector3& t) const { return over(t, director); }
  [[nodiscard]] Vector3 carried(double sine, double cosine, const Vector3& t) const {
    return over(t, cosine * director + sine * binormal);
  }

private:
  [[nodiscard]] Vector3 over(const Vector3& t, const Vector3& q) const {
    return q - (t.dot(q) / (1 + tangent.dot(t))) * (tangent + t);
  }
};

} // namespace sheet
