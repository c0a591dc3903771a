// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/mesh.h"

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/consistency.h"

namespace sheet::remesh {
namespace {

TEST(Mesh, FansAndRims) {
  // two triangles on the edge 1-2
  const std::vector<Corners> corners = {{0, 1, 2}, {2, 1, 3}};
  const Mesh mesh(5, corners);
  test::expect_consistent(mesh);
  EXPECT_EQ(mesh.degree(0), 1U);
  EXPECT_EQ(mesh.degree(1), 2U);
  EXPECT_EQ(mesh.degree(4), 0U);
  EXPECT_TRUE(mesh.on_rim(3));
  EXPECT_TRUE(mesh.adjacent(1, 2));
  EXPECT_TRUE(mesh.adjacent(3, 1));
  EXPECT_FALSE(mesh.adjacent(0, 3));
  EXPECT_EQ(mesh.to(mesh.find_side(2, 1)), 1U);
  EXPECT_EQ(mesh.find_side(0, 2), no_index); // the sheet is on the left of 2 -> 0 only
  std::vector<std::uint32_t> around;
  mesh.for_neighbours(1, [&](std::uint32_t w) { around.push_back(w); });
  EXPECT_EQ(around, (std::vector<std::uint32_t>{3, 2, 0}));
}

TEST(Mesh, RefusesPinchedVertices) {
  const std::vector<Corners> bow_tie = {{0, 1, 2}, {0, 3, 4}};
  try {
    const Mesh mesh(5, bow_tie);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("vertex 0"), std::string::npos) << error.what();
  }
}

TEST(Mesh, RefusesThreeTrianglesAtAnEdge) {
  const std::vector<Corners> fin = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_THROW(Mesh(5, fin), Error);
}

TEST(Mesh, ReplaceOpensAndRefines) {
  MeshOptions options;
  options.edge_length = 0.5;
  const TriangleMesh sphere = make_sphere(1, options);
  Mesh mesh(sphere.positions.size(), sphere.triangles);
  test::expect_consistent(mesh);
  std::vector<std::uint32_t> slots;
  const std::vector<std::uint32_t> refined = {5}, gone = {9};
  const Corners old = mesh.corners(5), hole = mesh.corners(9);
  const std::uint32_t v = mesh.next_vertex();
  EXPECT_EQ(mesh.add_vertex(), v);
  const std::vector<Corners> three = {{old[0], old[1], v}, {old[1], old[2], v}, {old[2], old[0], v}};
  mesh.replace(refined, three, slots);
  test::expect_consistent(mesh);
  EXPECT_EQ(slots.size(), 3U);
  EXPECT_EQ(slots[0], 5U); // its slot is used again
  EXPECT_EQ(mesh.degree(v), 3U);
  EXPECT_FALSE(mesh.on_rim(v));
  mesh.replace(gone, {}, slots);
  test::expect_consistent(mesh);
  EXPECT_TRUE(mesh.on_rim(hole[0]) && mesh.on_rim(hole[1]) && mesh.on_rim(hole[2]));
}

} // namespace
} // namespace sheet::remesh
