// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of a triangle mesh, by sorting half edges within buckets of their lower vertex.
#include "libsheet/geometry/connectivity.h"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/geometry/disjoint_sets.h"

namespace sheet {

namespace {

// Of an edge: its higher vertex, a triangle, and the corner opposite there.
struct Half {
  std::uint32_t high, triangle, corner;
};

// By the higher vertex, those of one in the order that they are in. Most vertices have few.
void sort_halves(std::span<Half> halves) {
  constexpr std::size_t few = 24;
  if (halves.size() > few) {
    std::stable_sort(halves.begin(), halves.end(), [](const Half& p, const Half& q) { return p.high < q.high; });
    return;
  }
  for (std::size_t i = 1; i < halves.size(); ++i) {
    const Half half = halves[i];
    std::size_t to = i;
    for (; to > 0 && halves[to - 1].high > half.high; --to)
      halves[to] = halves[to - 1];
    halves[to] = half;
  }
}

using EdgeTriangles = std::map<Edge, std::vector<std::uint32_t>>; // those that meet at an edge

EdgeTriangles triangles_by_edge(std::span<const Corners> triangles) {
  EdgeTriangles at;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
      at[{low, high}].push_back(t);
    }
  return at;
}

bool runs_upward(const Corners& triangle, const Edge& edge) {
  return triangle[(std::ranges::find(triangle, edge[0]) - triangle.begin() + 1) % 3] == edge[1];
}

// Whether turning triangles over cannot give the one that `first` hangs together with two sides. Each triangle counts
// twice, as it is and turned over; neighbours are joined as they fit. Edges where more than two meet do not join.
bool is_one_sided(std::span<const Corners> triangles, const EdgeTriangles& at, std::uint32_t first) {
  const std::uint64_t count = triangles.size();
  DisjointSets sides(2 * count);
  for (const auto& [edge, meet] : at)
    if (meet.size() == 2) {
      const bool fits = runs_upward(triangles[meet[0]], edge) != runs_upward(triangles[meet[1]], edge);
      sides.join(meet[0], meet[1] + (fits ? 0 : count));
      sides.join(meet[0] + count, meet[1] + (fits ? count : 0));
    }
  return sides.find(first) == sides.find(first + count);
}

// Of two triangles that run along an edge in the same direction.
[[noreturn]] void fail_at(const Edge& edge, std::uint32_t first, std::uint32_t second,
                          std::span<const Corners> triangles) {
  const EdgeTriangles at = triangles_by_edge(triangles);
  const std::string found = fmt::format("edge ({}, {}): triangles {} and {} run along it in the same direction",
                                        edge[0], edge[1], first, second);
  if (const std::size_t meet = at.at(edge).size(); meet > 2)
    fail(ExitCode::bad_input, "{}: {} triangles meet there, and a sheet has at most two: duplicate the edge's vertices",
         found, meet);
  if (is_one_sided(triangles, at, first))
    fail(
        ExitCode::bad_input,
        "{}, and turning faces does not help: the surface has one side only, as a Moebius strip has, and a sheet has "
        "two: cut it open there, along a row of edges from rim to rim or back to itself, by duplicating their vertices",
        found);
  fail(ExitCode::bad_input, "{}: turn the faces the same way", found);
}

} // namespace

Connectivity connect(std::size_t vertices, std::span<const Corners> triangles) {
  std::vector<std::size_t> start(vertices + 1, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& v = triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (v[i] >= vertices)
        fail(ExitCode::bad_input, "triangle {}: vertex {} of a mesh with {} vertices", t, v[i], vertices);
      const auto a = v[(i + 1) % 3], b = v[(i + 2) % 3];
      if (a == b)
        fail(ExitCode::bad_input, "triangle {}: vertex {} appears twice", t, a);
      if (std::min(a, b) < vertices)
        ++start[std::min(a, b) + 1];
    }
  }
  for (std::size_t v = 0; v < vertices; ++v)
    start[v + 1] += start[v];
  std::vector<Half> halves(3 * triangles.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto a = triangles[t][(i + 1) % 3], b = triangles[t][(i + 2) % 3];
      halves[next[std::min(a, b)]++] = {std::max(a, b), t, i};
    }

  Connectivity c;
  c.vertices = vertices;
  c.triangles.assign(triangles.begin(), triangles.end());
  c.triangle_edges.resize(triangles.size());
  c.edges.reserve(halves.size() / 2 + vertices);
  c.edge_triangles.reserve(c.edges.capacity());
  for (std::uint32_t low = 0; low < vertices; ++low) {
    const auto first = halves.begin() + static_cast<std::ptrdiff_t>(start[low]);
    const auto last = halves.begin() + static_cast<std::ptrdiff_t>(start[low + 1]);
    sort_halves({first, last});
    for (auto h = first; h != last; ++h) {
      if (h == first || h->high != (h - 1)->high) {
        c.edges.push_back({low, h->high});
        c.edge_triangles.push_back({no_index, no_index});
      }
      const int side = triangles[h->triangle][(h->corner + 1) % 3] == low ? 0 : 1;
      auto& slot = c.edge_triangles.back()[side];
      if (slot != no_index)
        fail_at({low, h->high}, slot, h->triangle, triangles);
      slot = h->triangle;
      c.triangle_edges[h->triangle][h->corner] = static_cast<std::uint32_t>(c.edges.size() - 1);
    }
  }
  return c;
}

std::uint32_t triangle_of(const Connectivity& mesh, const Corners& corners) {
  const auto [a, b, c] = corners;
  const Edge edge{std::min(a, b), std::max(a, b)};
  const auto at = std::lower_bound(mesh.edges.begin(), mesh.edges.end(), edge);
  if (at == mesh.edges.end() || *at != edge)
    return no_index;
  for (const std::uint32_t t : mesh.edge_triangles[static_cast<std::size_t>(at - mesh.edges.begin())])
    if (t != no_index && std::ranges::find(mesh.triangles[t], c) != mesh.triangles[t].end())
      return t;
  return no_index;
}

} // namespace sheet
