// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/solidify.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/perturb.h"
#include "libsheet/shape/shapes.h"

namespace sheet {
namespace {

constexpr double h = 0.05;

// The volume of the liquid: area times mean thickness, triangle by triangle.
double liquid_volume(const TriangleMesh& mesh, const std::vector<double>& thickness) {
  double volume = 0.0;
  for (const TriangleIndices& t : mesh.triangles) {
    TriangleMesh one;
    one.positions = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    one.triangles = {{0, 1, 2}};
    volume += measure(one).area * (thickness[t[0]] + thickness[t[1]] + thickness[t[2]]) / 3.0;
  }
  return volume;
}

void expect_solid(TriangleMesh mesh, long euler) {
  set_thickness(mesh, h, plane_wave(0.2 * h, 0.7, Eigen::Vector3d::UnitX()));
  const TriangleMesh solid = solidify(mesh, thickness_at_vertices(mesh));
  const MeshFigures f = measure(solid);
  EXPECT_EQ(f.boundary_edges, 0U);
  EXPECT_EQ(f.bad_edges, 0U);
  EXPECT_EQ(f.euler_characteristic(), euler);
  const double volume = liquid_volume(mesh, mesh.vertex_thickness);
  EXPECT_NEAR(f.volume, volume, 0.005 * volume);
}

TEST(Solidify, EnclosesTheLiquid) {
  const MeshOptions options{Pattern::irregular, 0.06, 1, {}};
  expect_solid(make_rectangle(1.0, 1.0, options), 2);
  expect_solid(make_annulus(0.4, 1.0, options), 0);
  expect_solid(make_sphere(1.0, options), 4);
  expect_solid(make_cap(1.0, 1.5, options), 2);
  expect_solid(make_tube(1.0, 1.0, options), 0);
}

TEST(Solidify, ThicknessOfTrianglesBecomesThatOfVertices) {
  TriangleMesh mesh = make_rectangle(1.0, 1.0, {Pattern::irregular, 0.1, 1, {}});
  EXPECT_THROW((void)thickness_at_vertices(mesh), Error);
  mesh.triangle_thickness.assign(mesh.triangles.size(), 0.25);
  for (const double thickness : thickness_at_vertices(mesh))
    EXPECT_NEAR(thickness, 0.25, 1e-15);
}

TEST(Solidify, EveryTriangleSaysWhereItComesFrom) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<std::uint32_t> origin;
  const TriangleMesh solid = solidify(mesh, std::vector<double>(4, 0.1), &origin);
  ASSERT_EQ(origin.size(), solid.triangles.size());
  for (std::size_t t = 0; t < solid.triangles.size();
       ++t) // it shares two vertices with the one it comes from, or three
    EXPECT_GE(std::ranges::count_if(mesh.triangles[origin[t]],
                                    [&](std::uint32_t v) {
                                      return std::ranges::any_of(solid.triangles[t],
                                                                 [&](std::uint32_t w) { return w % 4 == v; });
                                    }),
              t < 4 ? 3 : 2)
        << t;
}

} // namespace
} // namespace sheet
