// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/elimination_order.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "libsheet/linear/supernodal_factor.h"
#include "tests/support/meshes.h"

using namespace sheet;

namespace {

void expect_permutation(std::size_t vertices, std::span<const Edge> graph, int unknowns = 1) {
  std::vector<std::uint32_t> order = elimination_order(vertices, graph, unknowns), all(vertices);
  EXPECT_EQ(order, elimination_order(vertices, graph, unknowns));
  std::iota(all.begin(), all.end(), 0U);
  std::ranges::sort(order);
  EXPECT_EQ(order, all);
}

// Layers of n x n vertices, each joined to its neighbours in its layer and to the nine vertices over it.
std::vector<Edge> pile(std::uint32_t n, std::uint32_t layers) {
  std::vector<Edge> graph;
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) { return (z * n + y) * n + x; };
  const auto join = [&](std::uint32_t a, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (x < n && y < n && z < layers) // below 0: too large
      graph.push_back({a, at(x, y, z)});
  };
  for (std::uint32_t z = 0; z < layers; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        const std::uint32_t a = at(x, y, z);
        join(a, x + 1, y, z);
        join(a, x, y + 1, z);
        join(a, x + 1, y + 1, z);
        for (std::uint32_t dy = 0; dy < 3; ++dy)
          for (std::uint32_t dx = 0; dx < 3; ++dx)
            join(a, x + dx - 1, y + dy - 1, z + 1);
      }
  return graph;
}

// Of a factor with `unknowns` at each vertex.
double flops(std::span<const std::uint32_t> order, std::span<const Edge> graph, int unknowns) {
  std::vector<int> rank(order.size());
  std::vector<std::vector<int>> later(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    rank[order[k]] = static_cast<int>(k);
  for (const Edge& e : graph)
    later[std::min(rank[e[0]], rank[e[1]])].push_back(std::max(rank[e[0]], rank[e[1]]));
  NodeGraph nodes{{0}, {0}, {}};
  for (auto& list : later) {
    std::ranges::sort(list);
    nodes.later.insert(nodes.later.end(), list.begin(), list.end());
    nodes.first.push_back(nodes.first.back() + unknowns);
    nodes.start.push_back(static_cast<int>(nodes.later.size()));
  }
  SupernodalFactor<float> factor;
  factor.analyze(nodes);
  return factor.flops();
}

} // namespace

TEST(EliminationOrder, HasEachVertexOnceAndIsTheSameAgain) {
  for (const int n : {1, 30, 150}) { // the last is dissected
    const State s = test::at_rest(test::rectangle(1, 1, n, n, 0), 0.01);
    expect_permutation(s.positions.size(), s.mesh->edges);
  }
  expect_permutation(3, {});
}

TEST(EliminationOrder, PilesAreDissected) {
  const std::vector<Edge> graph = pile(24, 12);
  constexpr std::size_t vertices = 24 * 24 * 12;
  constexpr int few = 1, many = 6; // a factor of few is cheap
  expect_permutation(vertices, graph, many);
  EXPECT_LT(flops(elimination_order(vertices, graph, many), graph, many),
            0.8 * flops(elimination_order(vertices, graph, few), graph, many));
}
