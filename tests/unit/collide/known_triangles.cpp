// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles are found again where nothing about them has changed, and nowhere else.
#include "libsheet/collide/known_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "libsheet/collide/self_search.h"
#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

using Flags = std::vector<std::uint8_t>;

struct Known {
  test::Mesh mesh = test::rectangle(1, 1, 5, 5, 0.2);
  KnownTriangles triangles;

  Known() { triangles.remember(mesh.triangles, mesh.positions, mesh.positions); }
  [[nodiscard]] Flags unknown() const { return triangles.unknown(mesh.triangles, mesh.positions); }
  [[nodiscard]] Flags with(std::uint32_t vertex) const {
    Flags flags;
    for (const Corners& t : mesh.triangles)
      flags.push_back(std::count(t.begin(), t.end(), vertex) > 0);
    return flags;
  }
};

TEST(KnownTriangles, AreFoundUnderOtherNumbers) {
  Known k;
  std::vector<std::uint32_t> number(k.mesh.positions.size());
  std::iota(number.begin(), number.end(), 0U);
  std::shuffle(number.begin(), number.end(), std::mt19937_64(1));
  std::vector<Vector3> positions(number.size() + 1, Vector3(9, 9, 9)); // and one more
  for (std::size_t v = 0; v < number.size(); ++v)
    positions[number[v]] = k.mesh.positions[v];
  k.mesh.positions = positions;
  for (Corners& t : k.mesh.triangles)
    t = {number[t[1]], number[t[2]], number[t[0]]};
  std::reverse(k.mesh.triangles.begin(), k.mesh.triangles.end());
  EXPECT_EQ(k.unknown(), Flags(k.mesh.triangles.size(), 0));
}

TEST(KnownTriangles, NotWhereACornerHasMoved) {
  Known k;
  k.mesh.positions[14].z() = std::nextafter(k.mesh.positions[14].z(), 1);
  EXPECT_EQ(k.unknown(), k.with(14));
}

TEST(KnownTriangles, NotWhereTheyAreOthersOnTheSameVertices) {
  Known k;
  const Corners old = k.mesh.triangles[7];
  for (std::uint32_t v = 20; v < k.mesh.positions.size(); ++v) { // far from the triangle
    k.mesh.triangles[7] = {old[0], old[1], v};
    EXPECT_EQ(k.unknown()[7], 1) << v;
  }
}

// Torn apart at a vertex, two triangles that shared it touch each other.
TEST(KnownTriangles, NotWhereTwoVerticesStand) {
  Known k;
  const Flags beside = k.with(14);
  k.mesh.positions.push_back(k.mesh.positions[14]);
  const std::size_t torn = static_cast<std::size_t>(std::find(beside.begin(), beside.end(), 1) - beside.begin());
  std::replace(k.mesh.triangles[torn].begin(), k.mesh.triangles[torn].end(), 14U,
               static_cast<std::uint32_t>(k.mesh.positions.size() - 1));
  EXPECT_EQ(k.unknown(), beside);
  const Connectivity connectivity = connect(k.mesh.positions.size(), k.mesh.triangles);
  EXPECT_TRUE(SelfSearch(connectivity).crossing(k.mesh.positions, k.unknown()));
  k.triangles.remember(k.mesh.triangles, k.mesh.positions, k.mesh.positions);
  EXPECT_EQ(k.unknown(), beside); // nor when they stood there before
}

TEST(KnownTriangles, ThinOnesAreNotRemembered) {
  Known k;
  std::vector<Vector3> thin = k.mesh.positions;
  const Corners& t = k.mesh.triangles[7];
  thin[t[2]] = (thin[t[0]] + thin[t[1]]) / 2;
  k.triangles.remember(k.mesh.triangles, thin, k.mesh.positions);
  EXPECT_EQ(k.unknown()[7], 1);
  k.triangles.forget();
  EXPECT_EQ(k.unknown(), Flags(k.mesh.triangles.size(), 1));
}

} // namespace
} // namespace sheet::collide
