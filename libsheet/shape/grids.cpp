// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/grids.h"

namespace sheet {

std::vector<TriangleIndices> grid_triangles(std::uint32_t columns, std::uint32_t rows, bool closed) {
  const std::uint32_t width = closed ? columns : columns + 1;
  std::vector<TriangleIndices> triangles;
  triangles.reserve(std::size_t{2} * columns * rows);
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t right = closed && i + 1 == columns ? 0 : i + 1;
      const std::uint32_t a = j * width + i, b = j * width + right;
      const std::uint32_t c = (j + 1) * width + right, d = (j + 1) * width + i;
      if ((i + j) % 2 == 0) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  return triangles;
}

void stitch_rings(const std::vector<Eigen::Vector3d>& positions, Ring inner, Ring outer,
                  std::vector<TriangleIndices>& triangles) {
  std::uint32_t i = 0, o = 0;
  while (i < inner.count || o < outer.count) {
    const std::uint32_t a = inner.first + i % inner.count, b = outer.first + o % outer.count;
    const std::uint32_t next_a = inner.first + (i + 1) % inner.count, next_b = outer.first + (o + 1) % outer.count;
    const bool along_outer =
        i == inner.count || (o < outer.count && (positions[a] - positions[next_b]).squaredNorm() <=
                                                    (positions[next_a] - positions[b]).squaredNorm());
    if (along_outer) {
      triangles.push_back({a, b, next_b});
      ++o;
    } else {
      triangles.push_back({a, b, next_a});
      ++i;
    }
  }
}

void fan(std::uint32_t center, Ring ring, std::vector<TriangleIndices>& triangles) {
  for (std::uint32_t i = 0; i < ring.count; ++i)
    triangles.push_back({center, ring.first + i, ring.first + (i + 1) % ring.count});
}

} // namespace sheet
