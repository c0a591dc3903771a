// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a triangle, for searches that halve it.
#pragma once
#include <algorithm>
#include <array>

#include "libsheet/solid/distance.h"

namespace sheet::solid {

using Weights = std::array<double, 3>;       // barycentric
using TrianglePart = std::array<Weights, 3>; // the corners of a smaller triangle in a triangle

inline constexpr TrianglePart whole_triangle = {Weights{1, 0, 0}, Weights{0, 1, 0}, Weights{0, 0, 1}};

inline Weights middle(const TrianglePart& part) {
  Weights result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = (part[0][i] + part[1][i] + part[2][i]) / 3;
  return result;
}

inline Triangle3 place(const TrianglePart& part, const Triangle3& triangle) {
  return {point_of(triangle, part[0]), point_of(triangle, part[1]), point_of(triangle, part[2])};
}

// The longest side, named by the corner opposite to it.
struct LongestSide {
  double length;
  std::size_t opposite;
};
inline LongestSide longest_side(const Triangle3& t) {
  LongestSide result{-1, 0};
  for (std::size_t i = 0; i < 3; ++i)
    if (const double length = (t[(i + 1) % 3] - t[(i + 2) % 3]).norm(); length > result.length)
      result = {length, i};
  return result;
}

// The two parts made by a cut from the given corner to the middle of the side opposite to it.
inline std::array<TrianglePart, 2> halves(const TrianglePart& part, std::size_t corner) {
  const std::size_t next = (corner + 1) % 3, last = (corner + 2) % 3;
  Weights cut;
  for (std::size_t i = 0; i < 3; ++i)
    cut[i] = (part[next][i] + part[last][i]) / 2;
  TrianglePart first = part, second = part;
  first[last] = cut;
  second[next] = cut;
  return {first, second};
}

// The weights in the whole triangle of a point that has these in a part.
inline Weights in_whole(const TrianglePart& part, const Weights& weights) {
  Weights result{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      result[i] += weights[k] * part[k][i];
  return result;
}

// How far the farthest corner is from a point.
inline double radius_around(const Vector3& center, const Triangle3& t) {
  return std::max({(t[0] - center).norm(), (t[1] - center).norm(), (t[2] - center).norm()});
}

} // namespace sheet::solid
