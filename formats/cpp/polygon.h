// SPDX-License-Identifier: MIT
// Polygons of mesh files to triangles.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sheet::formats {

struct PolygonTriangles {
  std::vector<std::array<std::uint32_t, 3>> triangles; // of the points, in the polygon's sense
  std::string fault;                                   // why there are none; empty if all is well
};

// The triangles of a polygon that is nearly flat, convex or not, with at least three corners, of which no two
// neighbours are the same: a fan around the first corner where it is convex, else by clipping ears [Meisters 1975], in
// its mean plane. It may touch itself, as around a hole, but neither cross itself nor, with more than four corners,
// leave its plane by more than a tenth of its size. A polygon of which all corners are in a line becomes a fan.
[[nodiscard]] PolygonTriangles triangulate(std::span<const std::array<double, 3>> points,
                                           std::span<const std::uint32_t> corners);

} // namespace sheet::formats
