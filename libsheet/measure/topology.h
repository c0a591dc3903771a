// SPDX-License-Identifier: GPL-3.0-or-later
// How triangles hang together. Works on any triangles, also broken ones: a triangle that names a vertex out of range or
// twice is passed over.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet {

// True if the triangle names three different vertices below `vertices`.
[[nodiscard]] bool is_proper(const Corners& triangle, std::uint64_t vertices);

// A side of a triangle as seen from its edge, the unordered pair of its vertices.
struct Side {
  std::uint32_t low, high; // vertices of the edge, low < high
  std::uint64_t triangle;
  std::uint8_t opposite; // the corner (0, 1, 2) that the side does not touch
  bool ascending;        // counter-clockwise round its triangle, the side goes from low to high
};

// All sides of proper triangles, in ascending order of (low, high), then triangle: each edge's sides stand together.
[[nodiscard]] std::vector<Side> sorted_sides(std::span<const Corners> triangles, std::uint64_t vertices);

// The sides of one edge after another: calls visit(std::span<const Side>) for each.
template <class Visit> void for_each_edge(std::span<const Side> sides, Visit visit) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
      ++end;
    visit(sides.subspan(i, end - i));
    i = end;
  }
}

// Corner c of triangle t has number 3 t + c. Corners belong to one fan if they are at the same vertex and one reaches
// the other across edges. A vertex with several fans is pinched: sheets touch there in a point.
class Fans {
public:
  Fans(std::span<const Corners> triangles, std::span<const Side> sides);
  // The smallest corner of the fan.
  [[nodiscard]] std::uint64_t of(std::uint64_t corner) const { return root_[corner]; }

private:
  std::vector<std::uint64_t> root_;
};

struct Topology {
  std::uint64_t components = 0; // connected by common vertices
  std::uint64_t edges = 0;
  std::uint64_t boundary_edges = 0; // sides of one triangle only
  std::uint64_t boundary_loops = 0; // pinched vertices taken apart
  std::uint64_t unused_vertices = 0;
  std::uint64_t pinched_vertices = 0;
  std::uint64_t non_manifold_edges = 0;  // sides of more than two triangles
  std::int64_t euler_characteristic = 0; // used vertices - edges + triangles
  bool closed = false;                   // there are triangles, and no boundary edges
};
[[nodiscard]] Topology find_topology(std::span<const Corners> triangles, std::uint64_t vertices,
                                     std::span<const Side> sides);

// The vertices with more than one fan, ascending.
[[nodiscard]] std::vector<std::uint32_t> find_pinched(std::span<const Corners> triangles, std::uint64_t vertices,
                                                      const Fans& fans);

} // namespace sheet
