// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace sheet::solid {
namespace {

using Part = NearestOnTriangle::Part;

// Where the segment p-q pierces triangle t, or nothing.
std::optional<Vector3> piercing(const Vector3& p, const Vector3& q, const Triangle3& t) {
  const Vector3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above = normal.dot(p - t[0]), below = normal.dot(q - t[0]);
  if (above * below > 0 || above == below)
    return std::nullopt;
  const Vector3 x = p + above / (above - below) * (q - p);
  for (std::size_t i = 0; i < 3; ++i)
    if ((t[(i + 1) % 3] - t[i]).cross(x - t[i]).dot(normal) < 0)
      return std::nullopt;
  return x;
}

// The parameters of the nearest points p + s (q - p), a + t (b - a) of two segments.
struct SegmentPair {
  double s, t;
};
SegmentPair nearest_on_segments(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b) {
  const Vector3 d = q - p, e = b - a, r = p - a;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  const double determinant = dd * ee - de * de;
  double s = determinant > 0 ? std::clamp((de * er - ee * dr) / determinant, 0.0, 1.0) : 0.0;
  double t = ee > 0 ? (de * s + er) / ee : 0.0;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = dd > 0 ? std::clamp((de * t - dr) / dd, 0.0, 1.0) : 0.0;
  }
  return {s, t};
}

} // namespace

NearestOnTriangle nearest_on_triangle(const Vector3& x, const Triangle3& triangle) {
  const auto& [a, b, c] = triangle;
  const auto corner = [&](std::size_t i) {
    std::array<double, 3> weights{};
    weights[i] = 1;
    return NearestOnTriangle{triangle[i], weights, Part::corner, i};
  };
  // On the edge from corner i to the next one, a part t along it.
  const auto edge = [&](std::size_t i, double t) {
    const std::size_t j = (i + 1) % 3;
    std::array<double, 3> weights{};
    weights[i] = 1 - t;
    weights[j] = t;
    return NearestOnTriangle{triangle[i] + t * (triangle[j] - triangle[i]), weights, Part::edge, (i + 2) % 3};
  };
  const Vector3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0)
    return corner(0);
  const Vector3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3)
    return corner(1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
    return edge(0, d1 / (d1 - d3));
  const Vector3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6)
    return corner(2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
    return edge(2, 1 - d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return edge(1, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  return {a + v * ab + w * ac, {1 - v - w, v, w}, Part::face, 0};
}

TrianglePair nearest_points(const Triangle3& a, const Triangle3& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto x = piercing(b[i], b[(i + 1) % 3], a))
      return {0, *x, *x, nearest_on_triangle(*x, a).weights};
    if (const auto x = piercing(a[i], a[(i + 1) % 3], b))
      return {0, *x, *x, nearest_on_triangle(*x, a).weights};
  }
  TrianglePair best{std::numeric_limits<double>::infinity(), {}, {}, {}};
  double least = best.distance; // squared
  const auto offer = [&](const Vector3& first, const Vector3& second, const std::array<double, 3>& weights) {
    if (const double squared = (first - second).squaredNorm(); squared < least) {
      least = squared;
      best = {0, first, second, weights};
    }
  };
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<double, 3> weights{};
    weights[i] = 1;
    offer(a[i], nearest_on_triangle(a[i], b).point, weights);
    const NearestOnTriangle on_a = nearest_on_triangle(b[i], a);
    offer(on_a.point, b[i], on_a.weights);
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t j = (i + 1) % 3, l = (k + 1) % 3;
      const auto [s, t] = nearest_on_segments(a[i], a[j], b[k], b[l]);
      std::array<double, 3> weights{};
      weights[i] = 1 - s;
      weights[j] = s;
      offer(a[i] + s * (a[j] - a[i]), b[k] + t * (b[l] - b[k]), weights);
    }
  best.distance = std::sqrt(least);
  return best;
}

} // namespace sheet::solid
