// SPDX-License-Identifier: GPL-3.0-or-later
// In a good sheet nearly all candidates are neighbours that do not intersect and nearly lie in a plane, where exact
// predicates are slowest; so a separating direction is looked for first in floating point, and counts only if it
// separates by more than the rounding error.
#include "libsheet/geometry/triangle_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>

namespace sheet {

namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using SolidTriangle = Kernel::Triangle_3;

constexpr double rounding = std::numeric_limits<double>::epsilon() / 2;
// Below this, products may have lost digits to underflow, and no bound holds.
constexpr double tiny = 1e-200;

Point point(const Vector3d& x) { return {x[0], x[1], x[2]}; }

// Two triangles, corners rotated so that those that they share come first.
struct Pair {
  std::array<Vector3d, 3> a, b;
  int shared = 0;
};

// Range of the projections of some points onto a direction, widened by the rounding errors.
struct Shadow {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(const Vector3d& direction, const Vector3d& offset) {
    const double at = direction.dot(offset);
    // one rounding each in the offset, the product and two sums: below 4 u Σ|d_i o_i|; twice that for good measure
    const double error = 8 * rounding * direction.cwiseAbs().dot(offset.cwiseAbs()) + tiny;
    low = std::min(low, at - error);
    high = std::max(high, at + error);
  }
};

// True only if the direction surely separates the triangles, but for the vertex that they share (at most one).
bool separates(const Vector3d& direction, const Pair& p) {
  const Vector3d& origin = p.a[0];
  Shadow a, b;
  for (std::size_t i = static_cast<std::size_t>(p.shared); i < 3; ++i) {
    a.add(direction, p.a[i] - origin);
    b.add(direction, p.b[i] - origin);
  }
  if (p.shared == 1) // the shared vertex lies at 0, the others strictly on either side
    return (a.high < 0 && b.low > 0) || (b.high < 0 && a.low > 0);
  return a.high < b.low || b.high < a.low;
}

bool surely_apart(const Pair& p) {
  const Vector3d middle_a = (p.a[0] + p.a[1] + p.a[2]) / 3, middle_b = (p.b[0] + p.b[1] + p.b[2]) / 3;
  if (separates(middle_b - middle_a, p))
    return true;
  for (const auto* corners : {&p.a, &p.b}) {
    const auto& c = *corners;
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
    if (separates(normal, p))
      return true;
    for (std::size_t i = 0; i < 3; ++i)
      if (separates(normal.cross(c[(i + 1) % 3] - c[i]), p))
        return true;
  }
  return false;
}

// Neighbours across an edge overlap only if folded onto each other: then their normals, counter-clockwise in one with
// the edge's direction and in the other against it, point in opposite directions.
bool surely_unfolded(const Pair& p) {
  const Vector3d edge = p.a[1] - p.a[0], to_a = p.a[2] - p.a[0], to_b = p.b[2] - p.a[0];
  const double cosine = -edge.cross(to_a).dot(edge.cross(to_b));
  const double size = edge.lpNorm<1>() * edge.lpNorm<1>() * to_a.lpNorm<1>() * to_b.lpNorm<1>();
  return cosine > 64 * rounding * size + tiny;
}

bool intersect(const Pair& p) {
  if (p.shared == 2 ? surely_unfolded(p) : surely_apart(p))
    return false;
  const std::array<Point, 3> a = {point(p.a[0]), point(p.a[1]), point(p.a[2])};
  const std::array<Point, 3> b = {point(p.b[0]), point(p.b[1]), point(p.b[2])};
  switch (p.shared) {
  case 0:
    return CGAL::do_intersect(SolidTriangle(a[0], a[1], a[2]), SolidTriangle(b[0], b[1], b[2]));
  case 1:
    // What they have in common is convex. If it is more than the shared vertex, follow it away from there: it leaves
    // one of the triangles through the side opposite to the vertex.
    return CGAL::do_intersect(Segment(a[1], a[2]), SolidTriangle(b[0], b[1], b[2])) ||
           CGAL::do_intersect(Segment(b[1], b[2]), SolidTriangle(a[0], a[1], a[2]));
  default:
    // Two half-planes from one line have only the line in common, unless they are the same half-plane.
    return CGAL::orientation(a[0], a[1], a[2], b[2]) == CGAL::COPLANAR &&
           CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::POSITIVE;
  }
}

Pair make_pair(std::span<const Vector3d> x, const Corners& a, const Corners& b) {
  Pair p;
  std::size_t last_a = 3, last_b = 3, first = 0;
  std::array<bool, 3> taken{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = std::find(b.begin(), b.end(), a[i]);
    if (at == b.end()) {
      p.a[--last_a] = x[a[i]];
      continue;
    }
    p.a[first] = p.b[first] = x[a[i]];
    taken[static_cast<std::size_t>(at - b.begin())] = true;
    ++first;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (!taken[i])
      p.b[--last_b] = x[b[i]];
  p.shared = static_cast<int>(first);
  return p;
}

} // namespace

bool triangles_intersect(std::span<const Vector3d> x, const Corners& a, const Corners& b) {
  const Pair pair = make_pair(x, a, b);
  return pair.shared < 3 && intersect(pair);
}

bool corners_collinear(std::span<const Vector3d> x, const Corners& t) {
  return CGAL::collinear(point(x[t[0]]), point(x[t[1]]), point(x[t[2]]));
}

} // namespace sheet
