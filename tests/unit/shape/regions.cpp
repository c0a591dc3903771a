// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/regions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/shape/shapes.h"

namespace sheet {
namespace {

TEST(Regions, InnerAndOuterRimOfAnAnnulus) {
  const TriangleMesh mesh = make_annulus(0.4, 1.0, {Pattern::irregular, 0.1, 1, {}});
  EXPECT_EQ(boundary_loops(mesh).size(), 2U);
  const VertexSet inner = named_region(mesh, "inner_rim"), outer = named_region(mesh, "outer_rim");
  for (const std::uint32_t v : inner)
    EXPECT_NEAR(mesh.positions[v].norm(), 0.4, 1e-15);
  for (const std::uint32_t v : outer)
    EXPECT_NEAR(mesh.positions[v].norm(), 1.0, 1e-15);
  EXPECT_EQ(named_region(mesh, "rim").size(), inner.size() + outer.size());
}

TEST(Regions, LoopsHaveTheMeshOnTheirLeft) {
  const TriangleMesh mesh = make_rectangle(2.0, 1.0, {Pattern::structured, 0.0, 1, {{4, 2}}});
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 1U);
  ASSERT_EQ(loops[0].size(), 12U);
  double area = 0.0;
  for (std::size_t i = 0; i < 12; ++i) {
    const Eigen::Vector3d &a = mesh.positions[loops[0][i]], &b = mesh.positions[loops[0][(i + 1) % 12]];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_DOUBLE_EQ(area, 2.0); // positive: counter-clockwise
}

TEST(Regions, SidesOfARectangle) {
  const TriangleMesh mesh = make_rectangle(2.0, 1.0, {Pattern::irregular, 0.1, 1, {}});
  EXPECT_EQ(named_region(mesh, "x_min").size(), 11U);
  EXPECT_EQ(named_region(mesh, "y_max").size(), 21U);
  for (const std::uint32_t v : named_region(mesh, "x_max"))
    EXPECT_EQ(mesh.positions[v].x(), 1.0);
  EXPECT_EQ(named_region(mesh, "z_min").size(), mesh.positions.size()); // it is flat
}

TEST(Regions, BoxAndSphere) {
  const TriangleMesh mesh = make_rectangle(2.0, 2.0, {Pattern::structured, 0.0, 1, {{4, 4}}});
  EXPECT_EQ(in_box(mesh, {-0.5, -0.5, -1}, {0.5, 0.5, 1}).size(), 9U);
  EXPECT_EQ(in_sphere(mesh, {0, 0, 0}, 0.5).size(), 5U);
}

TEST(Regions, Errors) {
  EXPECT_THROW((void)named_region(make_sphere(1.0, {Pattern::equilateral, 0.3, 1, {}}), "rim"), Error);
  EXPECT_THROW((void)named_region(make_disk(1.0, {Pattern::equilateral, 0.3, 1, {}}), "inner_rim"), Error);
  EXPECT_THROW((void)named_region(make_tube(1.0, 1.0, {Pattern::equilateral, 0.3, 1, {}}), "outer_rim"), Error);
  EXPECT_THROW((void)named_region(make_disk(1.0, {Pattern::equilateral, 0.3, 1, {}}), "w_min"), Error);
  TriangleMesh book; // three triangles at one edge
  book.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  EXPECT_THROW((void)boundary_loops(book), Error);
  TriangleMesh pinched;
  pinched.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  pinched.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_THROW((void)boundary_loops(pinched), Error);
}

} // namespace
} // namespace sheet
