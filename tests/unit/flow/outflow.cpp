// SPDX-License-Identifier: GPL-3.0-or-later
// Outflow without physics: sheets that move as one.
#include <gtest/gtest.h>

#include "libsheet/flow/outflow.h"
#include "libsheet/geometry/connectivity.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using test::volume_of;

Scene with_outflow(const std::string& planes) {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nedge_length = 1\nthickness = 0.25\n"
                     "[material]\nviscosity = 1\ndensity = 3\n" +
                         planes,
                     "scene");
}

// 4 x 2 squares of 1 m, 0.25 m thick, with a velocity along x.
Frame moving() {
  Frame frame = test::grid(4, 2, 1, 0.25);
  for (Vector3& v : velocities(frame))
    v = {2, 0, 0};
  return frame;
}

double account(const Frame& frame, const char* name, std::size_t row = 0) {
  return frame.find(name)->values<double>()[row];
}

// The plane cuts the third column of squares in the middle: what is beyond leaves, the fourth column whole.
TEST(Outflow, EndsTheSheetAtThePlaneAndKeepsAccount) {
  Frame frame = moving();
  const double before = volume_of(frame);
  const Dropped out = let_out(frame, with_outflow("[[outflow]]\npoint = [2.5, 0, 0]\nnormal = [7, 0, 0]\n"));
  EXPECT_EQ(out.triangles, 4U);
  EXPECT_EQ(frame.triangles, 12U);
  EXPECT_EQ(frame.vertices, 12U);
  double end = 0;
  for (const Vector3& x : positions(frame))
    end = std::max(end, x.x());
  EXPECT_EQ(end, 2.5);
  const double left = account(frame, "outflow.volume");
  EXPECT_NEAR(left, 1.5 * 2 * 0.25, 2e-3); // test::grid is a little uneven
  EXPECT_DOUBLE_EQ(volume_of(frame) + left, before);
  EXPECT_DOUBLE_EQ(account(frame, "outflow.momentum"), 3 * left * 2);
  EXPECT_DOUBLE_EQ(account(frame, "outflow.energy"), 3 * left * 2 * 2 / 2.0);
}

// With self-contact what is wholly beyond goes, and no vertex moves but by what opens cracks, as in tearing.
TEST(Outflow, MovesNothingWhereTheSheetMayTouchItself) {
  const Frame whole = moving();
  Frame frame = whole;
  const Scene scene = with_outflow("[[outflow]]\npoint = [2.5, 0, 0]\nnormal = [1, 0, 0]\n[contact]\nself = true\n");
  const double before = volume_of(frame);
  EXPECT_EQ(let_out(frame, scene).triangles, 4U);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    EXPECT_TRUE(std::ranges::any_of(positions(whole), [&](const Vector3& x) {
      return (x - std::as_const(frame).find("position")->values<Vector3>()[v]).norm() < 2e-3;
    }));
  EXPECT_DOUBLE_EQ(volume_of(frame) + account(frame, "outflow.volume"), before);
  const Frame once = frame;
  EXPECT_EQ(let_out(frame, scene).triangles, 0U); // what hangs over the plane waits
  EXPECT_EQ(frame, once);
}

// What would be a sliver goes whole.
TEST(Outflow, LeavesNoSlivers) {
  Frame frame = moving();
  EXPECT_EQ(let_out(frame, with_outflow("[[outflow]]\npoint = [2.1, 0, 0]\nnormal = [1, 0, 0]\n")).triangles, 8U);
  double end = 0;
  for (const Vector3& x : positions(frame))
    end = std::max(end, x.x());
  EXPECT_NEAR(end, 2, 0.01);
}

// Of two vertices beyond the plane the one that is far beyond lies to the left of the other seen from behind, but to
// the right of it on the plane.
TEST(Outflow, TurnsNoTriangleOver) {
  const std::vector<Vector3> x{{2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {2.92, 0.95, 0}, {4, 0.9, 0}, {2.95, 1.8, 0}};
  const std::vector<Corners> t{{0, 3, 1}, {1, 3, 4}, {1, 4, 5}, {1, 5, 2}};
  Frame frame = make_frame(x, t, std::vector<double>(4, 0.05));
  const Dropped out = let_out(frame, with_outflow("[[outflow]]\npoint = [2.9, 0, 0]\nnormal = [1, 0, 0]\n"));
  EXPECT_EQ(out.triangles, 2U);
  ASSERT_EQ(frame.triangles, 2U);
  const auto at = positions(static_cast<const Frame&>(frame));
  for (const Corners& c : triangles(static_cast<const Frame&>(frame)))
    EXPECT_GT((at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]).z(), 0);
  EXPECT_DOUBLE_EQ(volume_of(frame) + account(frame, "outflow.volume"), 0.2);
}

TEST(Outflow, LeavesOtherFramesAsTheyAre) {
  Frame frame = moving();
  const Frame before = frame;
  EXPECT_EQ(let_out(frame, with_outflow("[[outflow]]\npoint = [4, 0, 0]\nnormal = [1, 0, 0]\n")).triangles, 0U);
  EXPECT_EQ(frame.arrays.size(), before.arrays.size());
  EXPECT_EQ(frame.vertices, before.vertices);
}

// A plane along a diagonal would leave triangles that touch at a vertex only: they come apart.
TEST(Outflow, LeavesAManifold) {
  Frame frame = moving();
  (void)let_out(frame, with_outflow("[[outflow]]\npoint = [2.6, 0, 0]\nnormal = [1, 0.9, 0]\n"
                                    "[[outflow]]\npoint = [2.6, 2, 0]\nnormal = [1, -0.9, 0]\n"));
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  std::vector<int> rims(frame.vertices, 0);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.on_rim(e))
      for (const auto v : mesh.edges[e])
        ++rims[v];
  for (const int count : rims)
    EXPECT_TRUE(count == 0 || count == 2);
}

TEST(Outflow, OfEverythingLeavesNoTriangle) {
  for (const char* contact : {"", "[contact]\nself = true\n"}) {
    Frame frame = moving();
    const double before = volume_of(frame);
    EXPECT_EQ(
        let_out(frame, with_outflow(std::string("[[outflow]]\npoint = [-1, 0, 0]\nnormal = [1, 0, 0]\n") + contact))
            .triangles,
        16U);
    EXPECT_EQ(frame.triangles, 0U);
    EXPECT_EQ(frame.vertices, 0U);
    EXPECT_DOUBLE_EQ(account(frame, "outflow.volume"), before);
  }
}

} // namespace
} // namespace sheet::flow
