// SPDX-License-Identifier: GPL-3.0-or-later
// A corner between two walls, as one in which a side stands on a floor, as if it were rounded. What runs down the one
// wall turns in it, and goes on along the other one, where in a sharp corner what follows would push it straight into
// the other wall.
//
// Of two planes with the unit normals n and n' and the distances d and d' from a place, the points that are nearer to
// each than y, and farther from the line at the distance y from both than r, are cut off. With c = n·n' that line is at
// a n + b n' from the place, a = -((d - y) - c (d' - y))/(1 - c²) and likewise b, and the place is on the surface that
// is o from the rounded corner where |a n + b n'| = r and y = o + r:
//   (d - y)² - 2c (d - y)(d' - y) + (d' - y)² = (1 - c²) r².
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "libsheet/geometry/facing_walls.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// Where a place is in such a corner.
struct InCorner {
  double distance = 0; // from the nearest wall, or the rounding between both [m]
  Vector3 normal;      // unit, out of what it is nearest to
  bool rounded = false;
};

// one, other: with distance [m] and unit normal of the walls at the place. radius: of the rounding [m].
template <class Point> [[nodiscard]] InCorner in_corner(const Point& one, const Point& other, double radius) {
  const InCorner sharp =
      one.distance <= other.distance ? InCorner{one.distance, one.normal} : InCorner{other.distance, other.normal};
  const double c = one.normal.dot(other.normal), sine2 = 1 - c * c, sum = one.distance + other.distance;
  const double product = (one.distance * one.distance - 2 * c * one.distance * other.distance +
                          other.distance * other.distance - sine2 * radius * radius) /
                         (2 * (1 - c));
  const double root = sum * sum - 4 * product;
  if (!(sine2 > 0 && root > 0))
    return sharp;
  const double line = (sum + std::sqrt(root)) / 2;
  const double a = -((one.distance - line) - c * (other.distance - line)) / sine2,
               b = -((other.distance - line) - c * (one.distance - line)) / sine2;
  if (!(a > 0 && b > 0))
    return sharp;
  return {line - radius, (a * one.normal + b * other.normal) / radius, true};
}

// The greatest radius of a rounding, up to `most` [m], that leaves a place between two walls at least half as far from
// it as from the nearer one of them. one, other: as above, both distances positive.
template <class Point> [[nodiscard]] double rounding_at(const Point& one, const Point& other, double most) {
  const double half = std::min(one.distance, other.distance) / 2;
  if (!(half > 0))
    return 0;
  const double p = one.distance - half, q = other.distance - half, c = one.normal.dot(other.normal);
  return std::min(most, (p + q + std::sqrt(2 * (1 + c) * p * q)) / (1 - c));
}

// The face of one hollow wall beside that nearest to a place x, where the two are a corner: above the nearest face, by
// `height` [m], it is the nearest one. Its distance is that from its plane. Faces that face each other have a gap, not
// a corner. nearest: gives distance and normal of the wall at a place.
template <class Nearest>
[[nodiscard]] auto face_beside(const Nearest& nearest, const Vector3& x, double height)
    -> std::optional<decltype(nearest(x))> {
  constexpr double bluntest = 0.9; // cosine of the angle between two faces that make one: 26 degrees
  const Vector3 face = nearest(x).normal, above = x + height * face;
  auto other = nearest(above);
  const double cosine = other.normal.dot(face);
  if (cosine > bluntest || cosine < -least_facing)
    return {};
  other.distance -= other.normal.dot(above - x);
  return other;
}

} // namespace sheet
