// SPDX-License-Identifier: GPL-3.0-or-later
// Who meets whom in a triangle mesh. Triangles are counter-clockwise from their positive side; edge i of a triangle
// lies opposite its vertex i; edges are (lower, higher) vertex, sorted, and point from the lower to the higher.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

using Edge = std::array<std::uint32_t, 2>;

struct Connectivity {
  std::size_t vertices = 0;
  std::vector<Corners> triangles;
  std::vector<Edge> edges;
  std::vector<std::array<std::uint32_t, 3>> triangle_edges; // [triangle][i]: the edge opposite vertex i
  std::vector<std::array<std::uint32_t, 2>>
      edge_triangles; // the triangle that runs lower to higher first; no_index: no such

  [[nodiscard]] bool on_rim(std::size_t edge) const {
    return edge_triangles[edge][0] == no_index || edge_triangles[edge][1] == no_index;
  }
};

// Fails with bad_input on an index out of range, a triangle with a repeated vertex, an edge of more than two triangles,
// or two triangles that run along their common edge in the same direction: then it says whether to turn some, or that
// the mesh has one side only.
[[nodiscard]] Connectivity connect(std::size_t vertices, std::span<const Corners> triangles);

// The triangle with these corners, in any order; no_index if there is none.
[[nodiscard]] std::uint32_t triangle_of(const Connectivity& mesh, const Corners& corners);

} // namespace sheet
