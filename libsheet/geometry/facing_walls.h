// SPDX-License-Identifier: GPL-3.0-or-later
// Two walls that face each other across what lies between them.
#pragma once
#include <algorithm>
#include <limits>

#include "libsheet/geometry/types.h"

namespace sheet {

inline constexpr double least_facing = 0.5; // cosine of the angle up to which two walls face each other: 60 degrees
inline constexpr double filled_gap = 1.05;  // gaps that a layer fills, in its thicknesses
inline constexpr double least_gap = 0.05;   // likewise: narrower ones count as so wide, and beside an edge as none

// How wide the gap is at a point between two walls [m], of which one is at the distance `own`, the other at `other`
// [m], with these unit normals out of the walls. Beyond an edge of the other wall it widens, to infinity where the two
// face each other no more: nothing jumps there.
[[nodiscard]] inline double gap_between(double own, const Vector3& own_normal, double other,
                                        const Vector3& other_normal) {
  const double cosine = -own_normal.dot(other_normal), turned = (1 - cosine) / (1 - least_facing);
  return turned < 1 ? own + other / (cosine * (1 - turned * turned)) : std::numeric_limits<double>::infinity();
}

// The place of a wall nearest to x, of its distance and normal there.
template <class Point> [[nodiscard]] Vector3 foot_on(const Point& point, const Vector3& x) {
  return x - point.distance * point.normal;
}

// How high another wall is above its own one where it is lowest, on a way along the own one from `foot` on [m]: 0 where
// it stands there. own, other: give distance and normal of the walls at a place.
template <class Own, class Other>
[[nodiscard]] double least_height(const Vector3& foot, const Vector3& way, const Own& own, const Other& other) {
  constexpr int parts = 16;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= parts; ++k) {
    const Vector3 place = foot + static_cast<double>(k) / parts * way;
    least = std::min(least, own(foot_on(other(place), place)).distance);
  }
  return least;
}

// The gap that another wall leaves a layer beside its edge: of a blade, a plate or a box above the own wall.
struct GapBeside {
  double gap = std::numeric_limits<double>::infinity(); // [m]
  Vector3 slope = Vector3::Zero();                      // of it, along the own wall
};

// At the foot of x on its own wall. The middle of a layer that comes to such an edge must be below it in time, and its
// triangles must not be higher than it where it cuts through them: with the gap g under the edge and the way s there
// along the wall,
//   gap = g (1 + 2 s/l)/(1 - (s/(2 l))²),
// l the longest edge of the mesh there: as if the edge were rounded over so much. Infinite from s = 2 l on, where the
// other wall does not face the own one across that place, as in a corner between them, where the own wall turns away on
// the way there, as on top of a rod over a floor, and where g is less than `least` [m], or becomes so within an edge of
// the mesh behind, as below a scraper that leans. own, other: give distance and normal of the walls at a place.
template <class Own, class Other>
[[nodiscard]] GapBeside gap_beside(const Vector3& x, const Own& own, const Other& other, double longest_edge,
                                   double least) {
  const auto at = own(x);
  const Vector3 foot = foot_on(at, x), edge = foot_on(other(foot), foot);
  const auto below = own(edge);
  const Vector3 beneath = foot_on(below, edge), way = foot - beneath;
  const double reach = 2 * longest_edge, part = way.norm() / reach;
  const bool turns_away = at.normal.dot(edge - foot) < least || at.normal.dot(below.normal) < least_facing;
  if (!(part < 1) || turns_away || below.distance < least)
    return {};
  const auto above = other(beneath);
  const double gap = gap_between(0, below.normal, above.distance, above.normal);
  const double ahead = way.norm();
  if (gap < least || (ahead > 0 && least_height(beneath, -longest_edge / ahead * way, own, other) < least))
    return {};
  const double narrowing = 1 - part * part, widened = (1 + 4 * part) / narrowing;
  const double slope = gap / reach * (4 + 2 * part * widened) / narrowing;
  return {gap * widened, part > 0 ? Vector3(slope / (part * reach) * way) : Vector3::Zero()};
}

} // namespace sheet
