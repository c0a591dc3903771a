// SPDX-License-Identifier: GPL-3.0-or-later
// The straight paths of a sheet's vertices through one time step, as sheet-collide corrects them. SI units.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/axes.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {

// By how many times the way (or the rate) that is wanted of a contact an impulse may change that of a vertex.
inline constexpr double longest_lever = 4;

// 1 along the axes that are free, 0 along the others.
[[nodiscard]] inline Vector3 free_part(Axes fixed) {
  return {has_axis(fixed, 0) ? 0.0 : 1.0, has_axis(fixed, 1) ? 0.0 : 1.0, has_axis(fixed, 2) ? 0.0 : 1.0};
}

// `x` where free, `prescribed` along the fixed axes.
[[nodiscard]] inline Vector3 with_fixed(Axes fixed, const Vector3& prescribed, const Vector3& x) {
  Vector3 result = x;
  for (int a = 0; a < 3; ++a)
    if (has_axis(fixed, a))
      result[a] = prescribed[a];
  return result;
}

// Vertex i goes from start[i] to end[i] between start_time and end_time. Corrections change `end`; the velocity of a
// vertex is changed by the same displacement divided by the step's length.
struct StepPath {
  double start_time = 0, end_time = 0; // [s], start_time < end_time
  Vector3 gravity = Vector3::Zero();   // [m/s²]
  std::span<const Corners> triangles;
  std::span<const Vector3> start; // [m], free of intersections unless the report says otherwise
  std::vector<Vector3> end;       // [m]
  std::vector<Vector3> velocity;  // at the end [m/s]
  std::vector<double> thickness;  // at each vertex [m]: volume / area of its triangles, less where these are crushed
  std::vector<double>
      mass; // of each vertex [kg]; a third of its triangles' (volume / 3 where the density is not given)
  std::vector<double> end_thickness; // the same at the end, where layers flow; none: as at the start
  std::vector<std::int32_t> touch;   // the solid that holds each vertex, or no_solid
  std::vector<Vector3> overshoot;    // of what a solid has caught: its end without that less `end` [m]; or none
  std::vector<Axes> fixed;           // where held or touching: moved by nothing else (infinite mass)

  // Of each vertex, for solids alone, set by resolve_solids (touch_distance.h), before that empty: by how much farther
  // than half its thickness it keeps from them [m], and how it faces at the start, if liquid flows on any.
  std::vector<double> stand_off;
  std::vector<Vector3> facing;

  [[nodiscard]] double length() const { return end_time - start_time; }
  // How far from a solid's surface a vertex is that lies on it.
  [[nodiscard]] double half_thickness(std::uint32_t v) const {
    return thickness[v] / 2 + (stand_off.empty() ? 0 : stand_off[v]);
  }
};

} // namespace sheet::collide
