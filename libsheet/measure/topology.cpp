// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/topology.h"

#include <algorithm>
#include <tuple>

#include "libsheet/geometry/disjoint_sets.h"

namespace sheet {

namespace {

// Numbers of the corners at the low and the high end of a side.
std::pair<std::uint64_t, std::uint64_t> ends(const Side& side) {
  const std::uint64_t first = 3 * side.triangle + (side.opposite + 1) % 3;
  const std::uint64_t second = 3 * side.triangle + (side.opposite + 2) % 3;
  return side.ascending ? std::pair{first, second} : std::pair{second, first};
}

constexpr std::uint64_t nowhere = ~std::uint64_t{0};

} // namespace

bool is_proper(const Corners& t, std::uint64_t vertices) {
  return t[0] < vertices && t[1] < vertices && t[2] < vertices && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

std::vector<Side> sorted_sides(std::span<const Corners> triangles, std::uint64_t vertices) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint64_t t = 0; t < triangles.size(); ++t) {
    if (!is_proper(triangles[t], vertices))
      continue;
    for (std::uint8_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangles[t][(i + 1) % 3], to = triangles[t][(i + 2) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), t, i, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

Fans::Fans(std::span<const Corners> triangles, std::span<const Side> sides) {
  DisjointSets sets(3 * triangles.size());
  for_each_edge(sides, [&](std::span<const Side> edge) {
    for (std::size_t i = 1; i < edge.size(); ++i) {
      sets.join(ends(edge[0]).first, ends(edge[i]).first);
      sets.join(ends(edge[0]).second, ends(edge[i]).second);
    }
  });
  root_ = sets.take();
}

std::vector<std::uint32_t> find_pinched(std::span<const Corners> triangles, std::uint64_t vertices, const Fans& fans) {
  std::vector<std::uint64_t> fan_at(vertices, nowhere);
  std::vector<std::uint32_t> pinched;
  for (std::uint64_t t = 0; t < triangles.size(); ++t) {
    if (!is_proper(triangles[t], vertices))
      continue;
    for (std::uint64_t i = 0; i < 3; ++i) {
      std::uint64_t& fan = fan_at[triangles[t][i]];
      if (fan == nowhere)
        fan = fans.of(3 * t + i);
      else if (fan != fans.of(3 * t + i))
        pinched.push_back(triangles[t][i]);
    }
  }
  std::sort(pinched.begin(), pinched.end());
  pinched.erase(std::unique(pinched.begin(), pinched.end()), pinched.end());
  return pinched;
}

Topology find_topology(std::span<const Corners> triangles, std::uint64_t vertices, std::span<const Side> sides) {
  Topology result;
  const Fans fans(triangles, sides);
  DisjointSets pieces(vertices);
  DisjointSets loops(3 * triangles.size());
  std::vector<std::uint64_t> on_boundary; // fans
  for_each_edge(sides, [&](std::span<const Side> edge) {
    ++result.edges;
    pieces.join(edge[0].low, edge[0].high);
    if (edge.size() > 2)
      ++result.non_manifold_edges;
    if (edge.size() != 1)
      return;
    ++result.boundary_edges;
    const auto [low, high] = ends(edge[0]);
    loops.join(fans.of(low), fans.of(high));
    on_boundary.push_back(fans.of(low));
  });
  std::vector<bool> used(vertices, false);
  std::uint64_t proper = 0;
  for (const Corners& t : triangles) {
    if (!is_proper(t, vertices))
      continue;
    ++proper;
    for (const std::uint32_t v : t)
      used[v] = true;
  }
  std::uint64_t used_vertices = 0;
  for (std::uint64_t v = 0; v < vertices; ++v) {
    used_vertices += used[v] ? 1 : 0;
    result.components += used[v] && pieces.find(v) == v ? 1 : 0;
  }
  for (std::uint64_t& fan : on_boundary)
    fan = loops.find(fan);
  std::sort(on_boundary.begin(), on_boundary.end());
  result.boundary_loops =
      static_cast<std::uint64_t>(std::unique(on_boundary.begin(), on_boundary.end()) - on_boundary.begin());
  result.unused_vertices = vertices - used_vertices;
  result.pinched_vertices = find_pinched(triangles, vertices, fans).size();
  result.euler_characteristic = static_cast<std::int64_t>(used_vertices) - static_cast<std::int64_t>(result.edges) +
                                static_cast<std::int64_t>(proper);
  result.closed = proper > 0 && result.boundary_edges == 0;
  return result;
}

} // namespace sheet
