// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/connectivity.h"

#include <vector>

#include <gtest/gtest.h>

namespace sheet {
namespace {

TEST(Connectivity, FindsTrianglesByTheirCorners) {
  const std::vector<Corners> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 4, 3}};
  const Connectivity mesh = connect(5, triangles);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    EXPECT_EQ(triangle_of(mesh, {a, b, c}), t);
    EXPECT_EQ(triangle_of(mesh, {c, b, a}), t);
    EXPECT_EQ(triangle_of(mesh, {b, a, c}), t);
  }
  EXPECT_EQ(triangle_of(mesh, {0, 2, 3}), no_index); // of edges that there are
  EXPECT_EQ(triangle_of(mesh, {0, 4, 1}), no_index);
}

} // namespace
} // namespace sheet
