// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/elimination_order.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

using namespace sheet;

namespace {

void expect_permutation(std::size_t vertices, std::span<const Edge> graph) {
  std::vector<std::uint32_t> order = elimination_order(vertices, graph), all(vertices);
  EXPECT_EQ(order, elimination_order(vertices, graph));
  std::iota(all.begin(), all.end(), 0U);
  std::ranges::sort(order);
  EXPECT_EQ(order, all);
}

} // namespace

TEST(EliminationOrder, HasEachVertexOnceAndIsTheSameAgain) {
  for (const int n : {1, 30, 150}) { // the last is dissected
    const State s = test::at_rest(test::rectangle(1, 1, n, n, 0), 0.01);
    expect_permutation(s.positions.size(), s.mesh->edges);
  }
  expect_permutation(3, {});
}
