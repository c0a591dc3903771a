// SPDX-License-Identifier: GPL-3.0-or-later
// The first frame: where its inlet is.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

using formats::Frame;

constexpr const char* liquid = "[material]\nviscosity = 1\ndensity = 1\n";

TEST(BuildFrame, TheInletIsABorderOfTheUndisturbedSheetWhereverItIsNow) {
  const Frame frame = build_frame(parse_scene(
      std::string("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nsegments = [8, 4]\npattern = \"structured\"\nplane = "
                  "\"xy\"\nthickness = 0.1\ncenter = [0, 0, 7]\nrotation = {axis = [1, 0, 0], angle = \"90 deg\"}\n"
                  "perturbation = {amplitude = 0.01, seed = 1}\n") +
          liquid + "[inflow]\nregion = \"y_max\"\nvelocity = [0, 0, -1]\n",
      "scene"));
  const auto bits = masks(frame, "inlet");
  const auto x = positions(frame), origins = frame.find("inlet_origin")->values<Eigen::Vector3d>();
  ASSERT_EQ(bits.size(), 45);
  for (std::size_t v = 0; v < 45; ++v) {
    EXPECT_EQ(bits[v], x[v].z() > 7.9 ? in_inlet | at_inlet_border : 0) << v; // y = 1 has become z = 8
    EXPECT_EQ(origins[v], x[v]);
  }
  EXPECT_EQ(std::ranges::count(bits, 3), 9);
  EXPECT_EQ(formats::find_value_error(frame), "");
}

TEST(BuildFrame, ASheetTurnsAboutItsCenter) {
  const Frame frame = build_frame(parse_scene(
      std::string(
          "[sheet]\nshape = \"disk\"\nradius = 2\nedge_length = 1\nplane = \"xy\"\nthickness = 0.1\ncenter = [7, "
          "0, 0]\nvelocity = [0, 0, 5]\nangular_velocity = [0, 0, \"3 rad/s\"]\n") +
          liquid,
      "scene"));
  const auto x = positions(frame), v = frame.find("velocity")->values<Eigen::Vector3d>();
  for (std::size_t i = 0; i < frame.vertices; ++i)
    EXPECT_LT((v[i] - Eigen::Vector3d(-3 * x[i].y(), 3 * (x[i].x() - 7), 5)).norm(), 1e-14) << i;
}

TEST(BuildFrame, ASheetOpensAwayFromItsAxis) {
  const Frame frame = build_frame(parse_scene(
      std::string("[sheet]\nshape = \"annulus\"\ninner_radius = 1\nouter_radius = 2\nedge_length = 1\nplane = \"xz\"\n"
                  "thickness = 0.1\ncenter = [7, 0, 0]\nrotation = {axis = [1, 0, 0], angle = \"90 deg\"}\n"
                  "velocity = [0, 0, 5]\nradial_velocity = 3\n") +
          liquid,
      "scene"));
  const auto x = positions(frame), v = frame.find("velocity")->values<Eigen::Vector3d>();
  for (std::size_t i = 0; i < frame.vertices; ++i) // its axis, y, has become z
    EXPECT_LT((v[i] - 3 * (x[i] - Eigen::Vector3d(7, 0, 0)).normalized() - Eigen::Vector3d(0, 0, 5)).norm(), 1e-14)
        << i;
}

TEST(BuildFrame, ThicknessFollowsRowsWhereverTheSheetIs) {
  const auto check = [](const std::string& shape, const std::string& profile, const auto& exact) {
    const Frame frame = build_frame(
        parse_scene("[sheet]\n" + shape +
                        "edge_length = 0.2\nplane = \"xy\"\ncenter = [7, 8, 9]\nthickness = " + profile + "\n" + liquid,
                    "scene"));
    const auto x = positions(frame);
    const Eigen::Vector3d center(7, 8, 9);
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const auto& c = triangles(frame)[t];
      const Eigen::Vector3d middle = (x[c[0]] + x[c[1]] + x[c[2]]) / 3 - center;
      const double area = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
      EXPECT_NEAR(volumes(frame)[t] / area, exact(middle), 1e-12) << t;
    }
  };
  using Eigen::Vector3d;
  check("shape = \"disk\"\nradius = 2\n", "{radial = [[0.5, 0.3], [1.5, 0.1]]}",
        [](const Vector3d& x) { return std::clamp(0.3 - 0.2 * (std::hypot(x.x(), x.y()) - 0.5), 0.1, 0.3); });
  check("shape = \"sphere\"\nradius = 1\n", "{radial = [[0, 0.1], [1, 0.2]]}",
        [](const Vector3d& x) { return 0.1 + 0.1 * std::hypot(x.x(), x.y()); });
  check("shape = \"rectangle\"\nsize = [2, 1]\n", "{along = \"x\", rows = [[-1, 0.1], [0, 0.3], [1, 0.1]]}",
        [](const Vector3d& x) { return 0.3 - 0.2 * std::abs(x.x()); });
  check("shape = \"tube\"\nradius = 1\nheight = 2\n", "{along = \"z\", rows = [[-1, 0.1], [1, 0.3]]}",
        [](const Vector3d& x) { return 0.2 + 0.1 * x.z(); });
}

TEST(BuildFrame, ARingIsAnInletAndNoInflowIsNone) {
  const std::string tube = "[sheet]\nshape = \"tube\"\nradius = 1\nheight = 2\nsegments = [12, 4]\npattern = "
                           "\"structured\"\nthickness = 0.1\n";
  const Frame frame =
      build_frame(parse_scene(tube + liquid + "[inflow]\nregion = \"y_max\"\nvelocity = [0, -1, 0]\n", "scene"));
  EXPECT_EQ(std::ranges::count(masks(frame, "inlet"), 3), 12);
  const Frame closed = build_frame(parse_scene(tube + liquid, "scene"));
  EXPECT_EQ(closed.find("inlet"), nullptr);
  EXPECT_EQ(closed.find("inlet_origin"), nullptr);
}

} // namespace
} // namespace sheet
