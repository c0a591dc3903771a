// SPDX-License-Identifier: GPL-3.0-or-later
// Two walls that face each other across what lies between them.
#pragma once
#include <limits>

#include "libsheet/geometry/types.h"

namespace sheet {

inline constexpr double least_facing = 0.5; // cosine of the angle up to which two walls face each other: 60 degrees

// How wide the gap is at a point between two walls [m], of which one is at the distance `own`, the other at `other`
// [m], with these unit normals out of the walls. Beyond an edge of the other wall it widens, to infinity where the two
// face each other no more: nothing jumps there.
[[nodiscard]] inline double gap_between(double own, const Vector3& own_normal, double other,
                                        const Vector3& other_normal) {
  const double cosine = -own_normal.dot(other_normal), turned = (1 - cosine) / (1 - least_facing);
  return turned < 1 ? own + other / (cosine * (1 - turned * turned)) : std::numeric_limits<double>::infinity();
}

} // namespace sheet
