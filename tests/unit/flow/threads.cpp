// SPDX-License-Identifier: GPL-3.0-or-later
// Two pads that hang together by a thread.
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/flow/threads.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using test::momentum;
using test::volume_of;

constexpr double shortest = 1.0 / 16; // [m]

Scene scene(const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nedge_length = 1\nthickness = 0.25\n"
                     "[material]\nviscosity = 1\ndensity = 3\n" +
                         more,
                     "scene");
}

// Pads of 8 x 2 squares of 1 m, 0.2 m thick, and between them a thread of 6 columns, `width` wide, 0.3 m long, which
// turn about the origin.
Frame dumbbell(double width, double of_thread = 0.01) {
  Frame frame = test::grid(22, 2, 1, 0.2);
  constexpr double left = 8, right = 14, column = 0.05;
  for (Vector3& x : positions(frame)) {
    if (x.x() > left - 0.3 && x.x() < right + 0.3)
      x.y() = 1 + (x.y() - 1) * width / 2;
    if (x.x() > left)
      x.x() = x.x() > right ? x.x() - (1 - column) * (right - left) : left + column * (x.x() - left);
  }
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] = test::area(frame, t) * (test::area(frame, t) < 0.01 ? of_thread : 0.2);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = Vector3(0, 0, 1).cross(positions(frame)[v]);
  return frame;
}

std::size_t pieces(const Frame& frame) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  DisjointSets sets(frame.triangles);
  for (const auto& [one, other] : mesh.edge_triangles)
    if (one != no_index && other != no_index)
      sets.join(one, other);
  const auto all = sets.take();
  return std::set<std::uint64_t>(all.begin(), all.end()).size();
}

TEST(Threads, AreCutAndAccountedFor) {
  Frame frame = dumbbell(0.02);
  const double volume = volume_of(frame);
  const Vector3 before = 3 * momentum(frame);
  const Shed cut = cut_threads(frame, scene(), shortest);
  EXPECT_GE(cut.sum.triangles, 12U);
  EXPECT_LE(cut.sum.triangles, 24U);
  EXPECT_EQ(pieces(frame), 2U);
  EXPECT_NEAR(volume_of(frame) + frame.find("tear.volume")->values<double>()[0], volume, 1e-14);
  const auto gone = frame.find("tear.momentum")->values<double>();
  EXPECT_NEAR((3 * momentum(frame) + Vector3(gone[0], gone[1], gone[2]) - before).norm(), 0, 1e-12);
  const Frame after = frame;
  EXPECT_EQ(cut_threads(frame, scene(), shortest).sum.triangles, 0U);
  EXPECT_EQ(frame, after);
}

// Edges could follow it, but the scene lets no strand be as narrow: 0.02 m, whatever the rows of triangles.
TEST(Threads, SnapBelowAWidth) {
  constexpr double fine = 1e-3;
  Frame frame = dumbbell(0.02);
  const Frame before = frame;
  EXPECT_EQ(cut_threads(frame, scene(), fine).sum.triangles, 0U);
  EXPECT_EQ(cut_threads(frame, scene("[tear]\nsnap = 0.008\n"), fine).sum.triangles, 0U);
  EXPECT_EQ(cut_threads(frame, scene("[tear]\nsnap = 0.0195\n"), fine).sum.triangles, 0U);
  EXPECT_EQ(frame, before);
  EXPECT_GE(cut_threads(frame, scene("[tear]\nsnap = 0.0205\n"), fine).sum.triangles, 12U);
  EXPECT_EQ(pieces(frame), 2U);
  EXPECT_NEAR(volume_of(frame) + frame.find("tear.volume")->values<double>()[0], volume_of(before), 1e-14);
}

// A round thread is π/4 of its thickness wide, so its section is above the square of its width.
TEST(Threads, SnapPartsRoundOnesToo) {
  constexpr double fine = 1e-3, width = 0.02, round = 4 / std::numbers::pi * width;
  Frame frame = dumbbell(width, round);
  EXPECT_EQ(cut_threads(frame, scene("[tear]\nsnap = 0.0195\n"), fine).sum.triangles, 0U);
  EXPECT_GE(cut_threads(frame, scene("[tear]\nsnap = 0.0205\n"), fine).sum.triangles, 12U);
  Frame beyond = dumbbell(width, 1.1 * round);
  EXPECT_EQ(cut_threads(beyond, scene("[tear]\nsnap = 0.0205\n"), fine).sum.triangles, 0U);
}

// Wide enough for triangles of its own, or with a section that counts, or of a mesh that is fine everywhere.
TEST(Threads, WhatIsNoneStays) {
  for (Frame frame : {dumbbell(0.1), dumbbell(0.02, 3), test::grid(6, 2, 0.02, 0.001)}) {
    const Frame before = frame;
    EXPECT_EQ(cut_threads(frame, scene(), shortest).sum.triangles, 0U);
    EXPECT_EQ(frame, before);
  }
}

// A coarse sheet, and beside it a fine one whose triangles are as small as a thread's.
TEST(Threads, FineSheetsAreNone) {
  const Frame coarse = test::grid(8, 8, 1, 0.2), fine = test::grid(8, 8, 0.02, 0.01);
  std::vector<Vector3> x(positions(coarse).begin(), positions(coarse).end());
  std::vector<Corners> t(triangles(coarse).begin(), triangles(coarse).end());
  std::vector<double> v(volumes(coarse).begin(), volumes(coarse).end());
  const auto first = static_cast<std::uint32_t>(x.size());
  for (const Vector3& at : positions(fine))
    x.push_back(at + Vector3(0, 0, 5));
  for (const Corners& c : triangles(fine))
    t.push_back({c[0] + first, c[1] + first, c[2] + first});
  v.insert(v.end(), volumes(fine).begin(), volumes(fine).end());
  Frame frame = make_frame(x, t, v);
  const Frame before = frame;
  EXPECT_EQ(cut_threads(frame, scene(), shortest).sum.triangles, 0U);
  EXPECT_EQ(frame, before);
}

TEST(Threads, WhatIsHeldStays) {
  Frame frame = dumbbell(0.02);
  formats::Array hold = formats::make_standard_array("hold", frame.vertices);
  for (std::uint64_t& bits : hold.values<std::uint64_t>())
    bits = 1;
  frame.put(std::move(hold));
  EXPECT_EQ(cut_threads(frame, scene("[[hold]]\nregion = \"rim\"\n"), shortest).sum.triangles, 0U);
}

} // namespace
} // namespace sheet::flow
