// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/cut.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

double length(const formats::Frame& frame, const CutCurve& curve) {
  double sum = 0;
  for (const auto& [start, end] : curve)
    sum += (position_of(frame, end) - position_of(frame, start)).norm();
  return sum;
}

// The square [0, 1]² in z = 0 of 2 n² triangles, all with the thickness 1 + x of their middles.
formats::Frame square(std::uint32_t n) {
  std::vector<Vector3> x;
  std::vector<Corners> t;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      x.emplace_back(double(i) / n, double(j) / n, 0);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      t.push_back({a, a + 1, a + n + 2});
      t.push_back({a, a + n + 2, a + n + 1});
    }
  std::vector<double> volume;
  for (const Corners& c : t)
    volume.push_back((1 + (x[c[0]].x() + x[c[1]].x() + x[c[2]].x()) / 3) / (2.0 * n * n));
  return make_frame(x, t, volume);
}

// A sphere of radius 1 about the origin, its positive side outside.
formats::Frame ball(std::uint32_t n) {
  std::vector<Vector3> x = {-Vector3::UnitY(), Vector3::UnitY()};
  for (std::uint32_t j = 1; j < n; ++j)
    for (std::uint32_t i = 0; i < 2 * n; ++i) {
      const double up = std::numbers::pi * j / n, around = std::numbers::pi * i / n;
      x.emplace_back(std::sin(up) * std::sin(around), -std::cos(up), std::sin(up) * std::cos(around));
    }
  const auto at = [&](std::uint32_t j, std::uint32_t i) { return 2 + (j - 1) * 2 * n + i % (2 * n); };
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    t.push_back({0, at(1, i + 1), at(1, i)});
    t.push_back({1, at(n - 1, i), at(n - 1, i + 1)});
    for (std::uint32_t j = 1; j + 1 < n; ++j) {
      t.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      t.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
  }
  return make_frame(x, t, std::vector<double>(t.size(), 1));
}

TEST(CutPlane, IsReadAsPeopleWriteIt) {
  EXPECT_EQ(parse_cut_plane("x=0").normal, Vector3::UnitX());
  EXPECT_EQ(parse_cut_plane("y = 2 mm").offset, 0.002);
  const CutPlane plane = parse_cut_plane("0.3x - 2*y+z=-1mm");
  EXPECT_EQ(plane.normal, Vector3(0.3, -2, 1));
  EXPECT_EQ(plane.offset, -0.001);
  EXPECT_EQ(parse_cut_plane("-x+1e-3y=0").normal, Vector3(-1, 0.001, 0));
  for (const char* text : {"", "x", "=", "x=", "=0", "w=0", "xy=0", "x=1s", "x=inf", "x-x=0", "2=x", "x+=0", "x0=0"})
    EXPECT_THROW((void)parse_cut_plane(text), Error) << text;
  EXPECT_EQ(parse_point("0, 2mm,-0.1"), Vector3(0, 0.002, -0.1));
  for (const char* text : {"", "0,0", "0,0,0,0", "0,0,1s", "a,b,c", "0,0,nan"})
    EXPECT_THROW((void)parse_point(text), Error) << text;
}

TEST(Cut, OfASquareGoesFromRimToRim) {
  const formats::Frame frame = square(8);
  const std::vector<std::pair<CutPlane, double>> planes = {{{Vector3::UnitX(), 0.3}, 1},
                                                           {{Vector3::UnitY(), 0.5}, 1}, // along edges
                                                           {{Vector3(1, 1, 0), 1}, std::numbers::sqrt2},
                                                           {{Vector3::UnitX(), 0}, 1}, // its rim: touches
                                                           {{Vector3::UnitX(), 1}, 1}};
  for (const auto& [plane, exact] : planes) {
    const auto curves = cut(frame, plane);
    ASSERT_EQ(curves.size(), 1);
    EXPECT_NEAR(length(frame, curves[0]), exact, 1e-12);
    for (std::size_t i = 0; i < curves[0].size(); ++i) {
      const auto& [start, end] = curves[0][i];
      EXPECT_NEAR(plane.normal.dot(position_of(frame, end)), plane.offset, 1e-15);
      EXPECT_GT((position_of(frame, end) - position_of(frame, start)).norm(), 0);
      if (i > 0) {
        EXPECT_EQ(position_of(frame, start), position_of(frame, curves[0][i - 1][1]));
      }
    }
    // above lies to the left, seen from the sheet's positive side
    const Vector3 way = position_of(frame, curves[0].back()[1]) - position_of(frame, curves[0].front()[0]);
    EXPECT_GT(Vector3::UnitZ().cross(way).dot(plane.normal), 0);
  }
  EXPECT_TRUE(cut(frame, {Vector3::UnitX(), 1.5}).empty());
  EXPECT_TRUE(cut(frame, {Vector3::UnitZ(), 0}).empty()); // lies in the plane
  EXPECT_TRUE(cut(make_frame({}, {}, {}), {}).empty());
}

TEST(Cut, CarriesTheTrianglesThicknessAndWhatIsInterpolatedBetweenVertices) {
  formats::Frame frame = square(8);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = {0, 0, 3 + positions(frame)[v].x() + 2 * positions(frame)[v].y()};
  const std::vector<double> thickness = values_of(frame, field_named("thickness"));
  const std::vector<double> speed = values_of(frame, field_named("speed"));
  double integral = 0;
  const auto curves = cut(frame, {Vector3::UnitY(), 0.4});
  for (const auto& [start, end] : curves.at(0)) {
    const Vector3 x = position_of(frame, start);
    EXPECT_NEAR(value_at(frame, field_named("speed"), speed, start), 3 + x.x() + 2 * x.y(), 1e-14);
    EXPECT_EQ(value_at(frame, field_named("thickness"), thickness, start),
              value_at(frame, field_named("thickness"), thickness, end));
    integral += thickness[start.triangle] * (position_of(frame, end) - x).norm();
  }
  // of 1 + x at the middles of triangles: 0.8 of each square's width lies below its diagonal, x = 2/3, 0.2 above, 1/3
  EXPECT_NEAR(integral, 1 + 3.5 / 8 + (0.8 * 2 + 0.2) / 3 / 8, 1e-14);
}

TEST(Cut, OfABallIsACircleFromItsLowestPlace) {
  const formats::Frame frame = ball(20);
  for (const Vector3& normal : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0.3, 0, 1)}) {
    const auto curves = cut(frame, {normal, 0.01});
    ASSERT_EQ(curves.size(), 1);
    const Vector3 first = position_of(frame, curves[0].front()[0]), last = position_of(frame, curves[0].back()[1]);
    EXPECT_EQ(first, last);
    EXPECT_NEAR(length(frame, curves[0]) / two_pi, 1, 0.01);
    const int axis = normal.y() == 1 ? 0 : 1;
    for (const auto& [start, end] : curves[0])
      EXPECT_GE(position_of(frame, start)[axis], first[axis]);
    const Vector3 way = position_of(frame, curves[0].front()[1]) - first;
    EXPECT_GT(first.cross(way).dot(normal), 0); // the ball's positive side is outside
  }
}

TEST(Cut, HasTheLongestCurveFirst) {
  // two squares in y = 0 and y = 1, the second half as large and turned over
  const std::vector<Vector3> x = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0.5, 1, 0}, {0, 1, 0.5}};
  const formats::Frame frame = make_frame(x, std::vector<Corners>{{3, 4, 5}, {0, 1, 2}}, std::vector<double>{1, 1});
  const auto curves = cut(frame, {Vector3::UnitX(), 0.1});
  ASSERT_EQ(curves.size(), 2);
  EXPECT_NEAR(length(frame, curves[0]), 0.9, 1e-15);
  EXPECT_NEAR(length(frame, curves[1]), 0.4, 1e-15);
}

TEST(NearestPoint, IsOverAFaceAtAnEdgeOrACorner) {
  const formats::Frame frame = square(4);
  const auto near = [&](const Vector3& x) { return position_of(frame, nearest_point(frame, x).value()); };
  EXPECT_LT((near({0.3, 0.6, 0.2}) - Vector3(0.3, 0.6, 0)).norm(), 1e-15);
  EXPECT_LT((near({0.3, -7, 2}) - Vector3(0.3, 0, 0)).norm(), 1e-15);
  EXPECT_LT((near({2, 3, -1}) - Vector3(1, 1, 0)).norm(), 1e-15);
  EXPECT_FALSE(nearest_point(make_frame({}, {}, {}), Vector3::Zero()));
}

} // namespace
} // namespace sheet
