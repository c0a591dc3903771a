// SPDX-License-Identifier: GPL-3.0-or-later
// The longest edge at each vertex.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

// x, result [m]; 0 at a vertex of no triangle.
[[nodiscard]] inline std::vector<double> longest_edges(std::span<const Vector3> x, std::span<const Corners> triangles) {
  std::vector<double> longest(x.size(), 0);
  for (const Corners& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      const double length = (x[a] - x[b]).norm();
      longest[a] = std::max(longest[a], length);
      longest[b] = std::max(longest[b], length);
    }
  return longest;
}

} // namespace sheet
