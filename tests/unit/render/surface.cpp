// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/surface.h"

#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/render/scenes.h"

namespace sheet::render {
namespace {

double enclosed_volume(const Surface& s) {
  double sum = 0;
  for (const Corners& t : s.triangles)
    sum += s.positions[t[0]].dot(s.positions[t[1]].cross(s.positions[t[2]])) / 6;
  return sum;
}

// Every directed edge has its opposite.
bool is_closed(const Surface& s) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const Corners& t : s.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++count[{t[i], t[(i + 1) % 3]}];
      --count[{t[(i + 1) % 3], t[i]}];
    }
  for (const auto& [edge, n] : count)
    if (n != 0)
      return false;
  return true;
}

TEST(Surface, AFlatSheetHasItsVolumeAndHalfARodForARim) {
  const double h = 0.02;
  const Surface s = make_surface(middle_of(test::flat(8, h)), 1e-4);
  EXPECT_TRUE(s.closed);
  EXPECT_TRUE(is_closed(s));
  // The half circle is cut into 6, corners are mitred.
  EXPECT_NEAR(enclosed_volume(s), h + 4 * std::numbers::pi * h * h / 8, 0.05 * h * h * 4);
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    EXPECT_NEAR(s.normals[i].norm(), 1, 1e-5);
  for (const float x : s.thickness)
    EXPECT_NEAR(x, h, 1e-8);
}

TEST(Surface, CurvedSheetsAreClosedToo) {
  for (const formats::Frame& frame : {test::trough(10, 0.05), test::ball(16, 0.03), test::flat(1, 0.1)})
    EXPECT_TRUE(is_closed(make_surface(middle_of(frame), 1e-4)));
}

TEST(Surface, NormalsPointOutOfTheTriangles) {
  const Surface s = make_surface(middle_of(test::trough(24, 0.01)), 1e-4);
  for (const Corners& t : s.triangles) {
    const Vector3 n = (s.positions[t[1]] - s.positions[t[0]]).cross(s.positions[t[2]] - s.positions[t[0]]).normalized();
    for (const std::uint32_t v : t)
      EXPECT_GT(n.dot(s.normals[v].cast<double>()), 0.6);
  }
}

TEST(Surface, ThinSheetsAreDrawnAsTheirMiddle) {
  const Surface s = make_surface(middle_of(test::flat(4, 1e-6)), 1e-4);
  EXPECT_FALSE(s.closed);
  EXPECT_EQ(s.triangles.size(), 32U);
}

TEST(Surface, TrianglesWithoutAreaAndPinchesDoNoHarm) {
  using V = Vector3;
  // Two triangles that meet at one vertex, and one without area.
  const std::vector<V> x = {V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(-1, 0, 0), V(0, -1, 0), V(2, 0, 0)};
  const std::vector<Corners> t = {{0, 1, 2}, {0, 3, 4}, {0, 1, 5}};
  const std::vector<double> v = {0.01, 0.01, 0.01};
  const Surface s = make_surface(middle_of(make_frame(x, t, v)), 1e-4);
  for (const Vector3& p : s.positions)
    EXPECT_TRUE(p.allFinite());
  for (const Vec& n : s.normals)
    EXPECT_TRUE(n.allFinite());
  EXPECT_EQ(s.source_triangle.size(), s.triangles.size());
  const Surface none = make_surface(middle_of(make_frame({}, {}, {})), 1e-4);
  EXPECT_TRUE(none.triangles.empty());
}

} // namespace
} // namespace sheet::render
