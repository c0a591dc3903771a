// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/vertex_shares.h"

#include <gtest/gtest.h>

namespace sheet {
namespace {

// Two triangles that share an edge, and a vertex of none.
const std::vector<Corners> triangles{{0, 1, 2}, {1, 3, 2}};
const std::vector<double> area{2, 4}, volumes{6, 3};

double area_of(std::uint32_t t) { return area[t]; }

TEST(VertexShares, AreThirdsOfTheTrianglesAround) {
  EXPECT_EQ(sum_around(5, triangles, area_of), (std::vector<double>{2, 6, 6, 4, 0}));
  EXPECT_EQ(vertex_shares(5, triangles, [](std::uint32_t t) { return 3 * area_of(t); }),
            (std::vector<double>{2, 6, 6, 4, 0}));
}

TEST(VertexShares, ThicknessIsAllVolumeOverAllArea) {
  EXPECT_EQ(thickness_around(5, triangles, volumes, area_of), (std::vector<double>{3, 1.5, 1.5, 0.75, 0}));
}

TEST(VertexShares, TrianglesWithoutAreaCountForNothing) {
  const auto flat = [](std::uint32_t t) { return t == 0 ? 0 : area[t]; };
  EXPECT_EQ(thickness_around(5, triangles, volumes, flat), (std::vector<double>{0, 0.75, 0.75, 0.75, 0}));
}

} // namespace
} // namespace sheet
