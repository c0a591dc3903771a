// SPDX-License-Identifier: GPL-3.0-or-later
// What the triangles around a vertex have, as the vertex sees it: the whole, its share of a third of each triangle, and
// the thickness there. `of_triangle(t)` says what triangle t has; sums run in the order of the triangles.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

// For each vertex the sum over the triangles around it.
template <class OfTriangle>
[[nodiscard]] std::vector<double> sum_around(std::size_t vertices, std::span<const Corners> triangles,
                                             OfTriangle of_triangle) {
  std::vector<double> sum(vertices, 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const double value = of_triangle(t);
    for (const std::uint32_t v : triangles[t])
      sum[v] += value;
  }
  return sum;
}

// For each vertex a third of what each triangle around it has: the lumped mass, volume or area.
template <class OfTriangle>
[[nodiscard]] std::vector<double> vertex_shares(std::size_t vertices, std::span<const Corners> triangles,
                                                OfTriangle of_triangle) {
  return sum_around(vertices, triangles, [&](std::uint32_t t) { return of_triangle(t) / 3; });
}

// For each vertex all volume [m³] over all area [m²] around it [m], 0 where there is no area. Triangles without area
// count for nothing.
template <class AreaOf>
[[nodiscard]] std::vector<double> thickness_around(std::size_t vertices, std::span<const Corners> triangles,
                                                   std::span<const double> volumes, AreaOf area_of) {
  std::vector<double> thickness(vertices, 0), area(vertices, 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (const double here = area_of(t); here > 0)
      for (const std::uint32_t v : triangles[t]) {
        thickness[v] += volumes[t];
        area[v] += here;
      }
  for (std::size_t v = 0; v < vertices; ++v)
    if (area[v] > 0)
      thickness[v] /= area[v];
  return thickness;
}

} // namespace sheet
