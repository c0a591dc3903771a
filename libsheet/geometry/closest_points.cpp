// SPDX-License-Identifier: GPL-3.0-or-later
// The minimum of |c|² over the closed parameter domain lies inside it, where its gradient vanishes, or on its border.
#include "libsheet/geometry/closest_points.h"

#include <algorithm>

namespace sheet {

namespace {

using Points = std::array<Vector3, 4>;

// Parameter in [0, 1] of the point of a + s (b - a) that is closest to p.
double along(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 e = b - a;
  const double length2 = e.squaredNorm();
  return length2 > 0 ? std::clamp((p - a).dot(e) / length2, 0.0, 1.0) : 0;
}

ClosestPoints candidate(const std::array<double, 4>& weights, const Points& x) {
  // differences first, so that coordinates far from the origin do no harm
  Vector3 c = Vector3::Zero();
  for (std::size_t i = 1; i < 4; ++i)
    c += weights[i] * (x[i] - x[0]);
  return {weights, c};
}

void keep_nearer(ClosestPoints& best, const ClosestPoints& other) {
  if (other.offset.squaredNorm() < best.offset.squaredNorm())
    best = other;
}

} // namespace

std::optional<ClosestPoints> over_triangle(const Points& x) {
  const Vector3 e1 = x[2] - x[1], e2 = x[3] - x[1], p = x[0] - x[1];
  const double a = e1.squaredNorm(), b = e1.dot(e2), c = e2.squaredNorm(), d = e1.dot(p), f = e2.dot(p);
  const double determinant = a * c - b * b;
  const double of_s = c * d - b * f, of_t = a * f - b * d;
  if (determinant > 0 && of_s > 0 && of_t > 0) { // as a rule not, and divisions take long
    const double s = of_s / determinant, t = of_t / determinant;
    if (s > 0 && t > 0 && s + t < 1)
      return candidate({1, s + t - 1, -s, -t}, x);
  }
  return std::nullopt;
}

ClosestPoints closest_vertex_triangle(const Points& x) {
  if (const auto over = over_triangle(x))
    return *over;
  ClosestPoints best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double s = along(x[0], x[1 + i], x[1 + j]);
    std::array<double, 4> weights{1, 0, 0, 0};
    weights[1 + i] = s - 1;
    weights[1 + j] = -s;
    const ClosestPoints side = candidate(weights, x);
    if (i == 0)
      best = side;
    else
      keep_nearer(best, side);
  }
  return best;
}

std::optional<ClosestPoints> crossing_edges(const Points& x) {
  const Vector3 u = x[1] - x[0], v = x[3] - x[2], w = x[0] - x[2];
  const double a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm(), d = u.dot(w), f = v.dot(w);
  const double determinant = a * c - b * b;
  const double of_s = b * f - c * d, of_t = a * f - b * d;
  if (determinant > 0 && of_s > 0 && of_s < determinant && of_t > 0 && of_t < determinant) {
    const double s = of_s / determinant, t = of_t / determinant; // points x0 + s u, x2 + t v
    if (s > 0 && s < 1 && t > 0 && t < 1)
      return candidate({1 - s, s, t - 1, -t}, x);
  }
  return std::nullopt;
}

ClosestPoints closest_edge_edge(const Points& x) {
  if (const auto crossing = crossing_edges(x))
    return *crossing;
  const double t0 = along(x[0], x[2], x[3]), t1 = along(x[1], x[2], x[3]);
  const double s0 = along(x[2], x[0], x[1]), s1 = along(x[3], x[0], x[1]);
  ClosestPoints best = candidate({1, 0, t0 - 1, -t0}, x);
  keep_nearer(best, candidate({0, 1, t1 - 1, -t1}, x));
  keep_nearer(best, candidate({1 - s0, s0, -1, 0}, x));
  keep_nearer(best, candidate({1 - s1, s1, 0, -1}, x));
  return best;
}

} // namespace sheet
