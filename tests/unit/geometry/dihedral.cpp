// SPDX-License-Identifier: GPL-3.0-or-later
// Sign of the dihedral angle, and connectivity of small meshes.
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/dihedral.h"
#include "libsheet/geometry/metric.h"

namespace sheet {
namespace {

TEST(Dihedral, IsPositiveOnARidge) {
  // Normals up (+z); apices pressed down by 45 degrees each.
  const double s = std::sqrt(0.5);
  const Vector3 a(0, 0, 0), b(0, 1, 0), left(-s, 0.5, -s), right(s, 0.5, -s);
  EXPECT_NEAR(dihedral_angle(a, b, left, right), std::numbers::pi / 2, 1e-14);
  EXPECT_NEAR(dihedral_angle(a, b, Vector3(-1, 0.5, 0), Vector3(1, 0.5, 0)), 0, 1e-14);
}

TEST(Metric, DissipationIsTraceOfSquarePlusSquareOfTrace) {
  const Vector3 u(1, 0.2, 0.1), v(0.3, 0.9, -0.2);
  const RaisedMetric a(squared_lengths(Vector3::Zero(), u, v));
  Eigen::Matrix2d metric, form;
  metric << u.dot(u), u.dot(v), u.dot(v), v.dot(v);
  form << 0.3, -0.2, -0.2, 0.7;
  const Vector3 m(form(0, 0) + form(1, 1) - 2 * form(0, 1), form(1, 1), form(0, 0));
  const Eigen::Matrix2d mixed = metric.inverse() * form;
  EXPECT_NEAR(m.dot(a.dissipation() * m), (mixed * mixed).trace() + mixed.trace() * mixed.trace(), 1e-13);
  EXPECT_NEAR(a.trace.dot(m), mixed.trace(), 1e-13);
  EXPECT_NEAR(a.area(), 0.5 * u.cross(v).norm(), 1e-14);
}

TEST(Connectivity, TwoTriangles) {
  const std::vector<Corners> triangles{{0, 1, 2}, {2, 1, 3}};
  const Connectivity c = connect(4, triangles);
  ASSERT_EQ(c.edges.size(), 5U);
  EXPECT_EQ(c.edges[0], (Edge{0, 1}));
  EXPECT_EQ(c.edges[2], (Edge{1, 2}));
  EXPECT_EQ(c.edge_triangles[2][0], 0U); // runs 1 -> 2
  EXPECT_EQ(c.edge_triangles[2][1], 1U);
  EXPECT_EQ(c.triangle_edges[1][2], 2U); // opposite vertex 3
  EXPECT_TRUE(c.on_rim(0));
  EXPECT_FALSE(c.on_rim(2));
}

TEST(Connectivity, RefusesWhatIsNoSurface) {
  const auto refused = [](std::vector<Corners> t) {
    try {
      (void)connect(5, t);
    } catch (const Error& e) {
      return e.code() == ExitCode::bad_input;
    }
    return false;
  };
  EXPECT_TRUE(refused({{0, 1, 7}}));
  EXPECT_TRUE(refused({{0, 1, 1}}));
  EXPECT_TRUE(refused({{0, 1, 2}, {0, 1, 3}}));
  EXPECT_TRUE(refused({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
}

// A strip of pairs of triangles, whose last vertices are the first, or the first the other way round.
std::vector<Corners> band(std::uint32_t pairs, bool twisted) {
  std::vector<Corners> triangles;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1, last = i + 1 == pairs ? 1 : 0, next = 2 * ((i + 1) % pairs),
                        c = next + (twisted ? last : 0), d = next + 1 - (twisted ? last : 0);
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
  }
  return triangles;
}

TEST(Connectivity, SaysWhatHelps) {
  const auto told = [](const std::vector<Corners>& t) -> std::string {
    try {
      (void)connect(40, t);
    } catch (const Error& e) {
      return e.what();
    }
    return "a surface";
  };
  using testing::HasSubstr;
  using testing::Not;
  std::vector<Corners> ring = band(6, false), strip = band(6, true);
  EXPECT_EQ(told(ring), "a surface");
  EXPECT_THAT(told(strip), HasSubstr("one side only"));
  for (std::vector<Corners>* mesh : {&ring, &strip})
    for (const std::size_t t : {3, 4, 9})
      std::swap((*mesh)[t][0], (*mesh)[t][1]);
  EXPECT_THAT(told(ring), HasSubstr("turn the faces the same way"));
  EXPECT_THAT(told(strip), HasSubstr("one side only"));
  strip.push_back({30, 31, 32}); // that another piece is one-sided does not matter to this one
  strip.push_back({30, 31, 33});
  for (Corners& t : strip)
    for (std::uint32_t& v : t)
      v = (v + 10) % 40; // it comes first
  EXPECT_THAT(told(strip), HasSubstr("turn the faces the same way"));
  EXPECT_THAT(told({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), HasSubstr("3 triangles meet there"));
}

} // namespace
} // namespace sheet
