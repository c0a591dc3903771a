// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/flow/tear.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/triangle_pair.h"
#include "tests/support/meshes.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using test::error_of;
using test::momentum;
using testing::HasSubstr;

constexpr double thin = 0.01, thick = 0.1, below = 0.05;

Scene tearing_scene(const std::string& more = "", double threshold = below) {
  return parse_scene("[sheet]\nshape = \"sphere\"\nradius = 10\nedge_length = 1\nthickness = 10000000\n[material]\n"
                     "viscosity = 1\ndensity = 3\n[tear]\nbelow = " +
                         std::to_string(threshold) + "\n" + more,
                     "scene");
}

const Scene keep = tearing_scene(), drop = tearing_scene("crumbs = \"drop\"\n");

Frame frame_of(const test::Mesh& mesh) {
  Frame frame = make_frame(mesh.positions, mesh.triangles, std::vector<double>(mesh.triangles.size(), 1));
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] = thick * test::area(frame, t);
  return frame;
}

// Makes triangles thin whose middle is at a place that `where` picks.
template <class Where> void make_thin(Frame& frame, Where where) {
  const auto x = positions(static_cast<const Frame&>(frame));
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    if (where(Vector3((x[c[0]] + x[c[1]] + x[c[2]]) / 3)))
      volumes(frame)[t] = thin * test::area(frame, t);
  }
}

// What a torn sheet is, in numbers.
struct Shape {
  std::size_t pieces = 0, smallest_piece = 0, holes = 0, pinched = 0;
  std::size_t isolated = 0; // triangles with three open sides
  std::size_t touching = 0; // pairs of triangles that meet in more than they share
  long euler = 0;
  bool operator==(const Shape&) const = default;
};

Shape shape_of(const Frame& frame) {
  Shape shape;
  const auto corners = triangles(frame);
  const Connectivity mesh = connect(frame.vertices, corners);
  DisjointSets pieces(frame.triangles), fans(3 * frame.triangles), loops(frame.vertices);
  const auto corner_at = [&](std::uint32_t t, std::uint32_t v) {
    return 3 * std::size_t{t} + static_cast<std::size_t>(std::ranges::find(corners[t], v) - corners[t].begin());
  };
  std::vector<int> open(frame.triangles, 0);
  std::vector<bool> on_rim(frame.vertices, false);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [s, t] = mesh.edge_triangles[e];
    if (mesh.on_rim(e)) {
      ++open[s == no_index ? t : s];
      loops.join(mesh.edges[e][0], mesh.edges[e][1]);
      for (const std::uint32_t v : mesh.edges[e])
        on_rim[v] = true;
      continue;
    }
    pieces.join(s, t);
    for (const std::uint32_t v : mesh.edges[e])
      fans.join(corner_at(s, v), corner_at(t, v));
  }
  shape.isolated = static_cast<std::size_t>(std::ranges::count(open, 3));
  std::map<std::uint64_t, std::size_t> sizes;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    ++sizes[pieces.find(t)];
  shape.pieces = sizes.size();
  shape.smallest_piece = frame.triangles;
  for (const auto& [piece, size] : sizes)
    shape.smallest_piece = std::min(shape.smallest_piece, size);
  std::map<std::uint32_t, std::set<std::uint64_t>> fans_at;
  for (std::uint32_t t = 0; t < frame.triangles; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      fans_at[corners[t][i]].insert(fans.find(3 * t + i));
  for (const auto& [v, found] : fans_at)
    shape.pinched += found.size() - 1;
  std::set<std::uint64_t> rims;
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    if (on_rim[v])
      rims.insert(loops.find(v));
  shape.holes = rims.size();
  shape.euler = static_cast<long>(frame.vertices + frame.triangles) - static_cast<long>(mesh.edges.size());
  for (std::size_t s = 0; s < corners.size(); ++s)
    for (std::size_t t = s + 1; t < corners.size(); ++t)
      shape.touching += triangles_intersect(positions(frame), corners[s], corners[t]) ? 1 : 0;
  return shape;
}

void set_turning(Frame& frame) {
  const auto v = velocities(frame);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = Vector3(1, 2, 3).cross(positions(frame)[i]) + Vector3(0.5, 0, 0);
}

using test::value_error;

TEST(Tear, NothingThinNothingChanges) {
  Frame frame = frame_of(test::disk(1, 4, 0.2));
  set_turning(frame);
  const Frame before = frame;
  EXPECT_EQ(tear(frame, keep).edges, 0);
  EXPECT_EQ(frame, before);
}

TEST(Tear, OneThinEdgeInsideOpensNothing) {
  Frame frame = test::grid(4, 4, 1, thick);
  volumes(frame)[10] = volumes(frame)[11] = thin / 2; // one square: its diagonal has two thin triangles
  const Frame before = frame;
  EXPECT_EQ(tear(frame, keep).edges, 0);
  EXPECT_EQ(frame, before);
}

TEST(Tear, AHoleOpensInAThinSpot) {
  Frame frame = frame_of(test::disk(1, 6, 0.2));
  make_thin(frame, [](const Vector3& x) { return x.norm() < 0.3; });
  set_turning(frame);
  const Vector3 p = momentum(frame);
  const std::vector<double> before(volumes(frame).begin(), volumes(frame).end());
  ASSERT_EQ(shape_of(frame).euler, 1);
  const Torn torn = tear(frame, keep);
  EXPECT_GT(torn.edges, 1);
  EXPECT_GT(torn.vertices, 0);
  const Shape shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 1);
  EXPECT_GT(shape.holes, 1);
  EXPECT_EQ(shape.euler, 1 - static_cast<long>(shape.holes - 1));
  EXPECT_EQ(shape.isolated + shape.pinched + shape.touching, 0);
  EXPECT_EQ(std::vector(volumes(frame).begin(), volumes(frame).end()), before);
  EXPECT_LT((momentum(frame) - p).norm(), 1e-15);
  EXPECT_EQ(value_error(frame), "");
  EXPECT_EQ(tear(frame, keep).edges, 0); // all is done
}

TEST(Tear, AThinBandParts) {
  Frame frame = test::grid(9, 12, 1, thick);
  make_thin(frame, [](const Vector3& x) { return std::abs(x[1] - 6) < 1; });
  tear(frame, keep);
  const Shape shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 2);
  EXPECT_EQ(shape.isolated + shape.pinched + shape.touching, 0);
}

// A cone with a thin band across its top, and a splinter under it where one lip would go: the sheet stays whole there.
TEST(Tear, LipsDoNotGoThroughOtherLayers) {
  const Frame flat = test::grid(8, 8, 1, thick);
  std::vector<Vector3> x(positions(flat).begin(), positions(flat).end());
  for (Vector3& p : x)
    p.z() = -(p - Vector3(4, 4, 0)).norm();
  std::vector<Corners> t(triangles(flat).begin(), triangles(flat).end());
  std::vector<double> v(volumes(flat).begin(), volumes(flat).end());
  const auto torn = [&] {
    Frame frame = make_frame(x, t, v);
    make_thin(frame, [](const Vector3& p) { return std::abs(p[1] - 4) < 1; });
    const Torn result = tear(frame, keep);
    EXPECT_EQ(shape_of(frame).touching, 0);
    return result;
  };
  const Torn alone = torn();
  EXPECT_GT(alone.edges, 4);
  EXPECT_EQ(alone.crossing, 0);
  const auto n = static_cast<std::uint32_t>(x.size());
  x.insert(x.end(), {{4 - 1e-5, 3.999, -1.02e-3}, {4 + 1e-5, 3.999, -1.02e-3}, {4, 3.999, -1.5e-3}});
  t.push_back({n, n + 1, n + 2});
  v.push_back(thick * 1e-8);
  const Torn with_splinter = torn();
  EXPECT_GT(with_splinter.crossing, 0);
  EXPECT_EQ(with_splinter.edges + with_splinter.crossing, alone.edges);
}

TEST(Tear, AStripTwoTrianglesWideSnaps) {
  Frame frame = frame_of(test::rectangle(12, 2, 12, 2, 0));
  make_thin(frame, [](const Vector3& x) { return std::abs(x[0] - 6) < 1.1; });
  tear(frame, keep);
  EXPECT_EQ(shape_of(frame).pieces, 2);
}

TEST(Tear, AllThin) {
  for (const Scene& scene : {keep, drop}) {
    Frame frame = frame_of(test::rectangle(10, 10, 20, 20, 0.2));
    make_thin(frame, [](const Vector3&) { return true; });
    const double before = test::volume_of(frame);
    const Torn torn = tear(frame, scene);
    const Shape shape = shape_of(frame);
    EXPECT_GE(shape.smallest_piece, 8);
    EXPECT_EQ(shape.isolated + shape.pinched + shape.touching, 0);
    EXPECT_NEAR(test::volume_of(frame) + torn.volume, before, 1e-15 * before);
    EXPECT_EQ(torn.dropped > 0, scene.tear->drop_crumbs);
    EXPECT_EQ(value_error(frame), "");
  }
}

// The smallest sheets.
TEST(Tear, EmptyOneTwoAndThreeTriangles) {
  Frame empty = make_frame({}, {}, {});
  EXPECT_EQ(tear(empty, keep).edges, 0);
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  const std::vector<Corners> t{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  for (std::size_t n = 1; n <= 3; ++n)
    for (const Scene& scene : {keep, drop}) {
      Frame frame = make_frame(std::span(x).first(n + 2), std::span(t).first(n), std::vector<double>(n, thin / 2));
      const Frame before = frame;
      EXPECT_EQ(tear(frame, scene).edges, 0);
      EXPECT_EQ(frame, before); // whole: there would be nothing left but crumbs
    }
}

TEST(Tear, ABowTieComesApart) {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0.5, 0}, {1, -0.5, 0}, {-1, 0.5, 0}, {-1, -0.5, 0}};
  const std::vector<Corners> t{{0, 2, 1}, {0, 3, 4}};
  Frame frame = make_frame(x, t, std::vector<double>{thick / 2, thick / 4});
  formats::Array mass = formats::make_array("mass", formats::Place::vertex, formats::Type::float64, 1, "kg",
                                            formats::Transfer::conserve, 5);
  std::ranges::fill(mass.values<double>(), 3.0);
  frame.put(mass);
  const Torn torn = tear(frame, keep);
  EXPECT_EQ(torn.edges, 0);
  EXPECT_EQ(torn.vertices, 1);
  EXPECT_EQ(frame.vertices, 6);
  const Shape shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 2);
  EXPECT_EQ(shape.pinched + shape.touching, 0);
  EXPECT_NEAR(positions(frame)[0][0], 1e-3, 1e-15);
  EXPECT_NEAR(positions(frame)[5][0], -1e-3, 1e-15);
  const auto shared = frame.find("mass")->values<double>();
  EXPECT_NEAR(shared[0], 2, 1e-15); // as the volumes
  EXPECT_NEAR(shared[5], 1, 1e-15);
  EXPECT_EQ(tear(frame, keep).vertices, 0);
}

TEST(Tear, AnAnnulusWithAHoleOfThreeEdges) {
  // Rings of 3, 6 and 12 around a triangular hole.
  const test::Mesh disk = test::disk(1, 4, 0);
  std::vector<Corners> corners;
  for (const Corners& c : disk.triangles)
    if (std::ranges::find(c, 0U) == c.end())
      corners.push_back(c);
  // vertices 2, 4, 6 of the inner ring of six go into 1, 3, 5
  for (Corners& c : corners)
    for (std::uint32_t& v : c)
      if (v == 2 || v == 4 || v == 6)
        --v;
  std::erase_if(corners, [](const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; });
  std::vector<Vector3> x = disk.positions;
  Frame frame = make_frame(x, corners, std::vector<double>(corners.size(), 1));
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] = thick * test::area(frame, t);
  make_thin(frame, [](const Vector3& p) { return p[0] > 0 && std::abs(p[1]) < 0.3; });
  ASSERT_EQ(shape_of(frame).holes, 2);
  const Torn torn = tear(frame, keep);
  EXPECT_GT(torn.edges, 2);
  const Shape shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 1);
  EXPECT_EQ(shape.holes, 1); // cut open
  EXPECT_EQ(shape.isolated + shape.pinched, 0);
}

TEST(Tear, AClosedSheetOpensAnOpenOneBesideItStays) {
  test::Mesh both = test::icosphere(2);
  const auto n = static_cast<std::uint32_t>(both.positions.size());
  const test::Mesh patch = test::rectangle(4, 4, 4, 4, 0.1);
  for (const Vector3& x : patch.positions)
    both.positions.push_back(x + Vector3(5, 0, 0));
  for (const Corners& c : patch.triangles)
    both.triangles.push_back({c[0] + n, c[1] + n, c[2] + n});
  Frame frame = frame_of(both);
  make_thin(frame, [](const Vector3& x) { return x[0] < 3 && x[2] > 0.6; });
  tear(frame, keep);
  const Shape shape = shape_of(frame);
  EXPECT_GT(shape.holes, 1);
  EXPECT_GE(shape.smallest_piece, 8);
  EXPECT_TRUE(std::equal(triangles(frame).end() - 32, triangles(frame).end(), both.triangles.end() - 32)); // the patch
  EXPECT_EQ(shape.isolated + shape.pinched + shape.touching, 0);
}

// A square of 4 triangles round vertex 12 of a grid of 4 x 4, thin all around: a crumb.
Frame crumb() {
  Frame frame = test::grid(8, 8, 1, thick);
  make_thin(frame, [](const Vector3& x) {
    const double r = (x - Vector3(4, 4, 0)).lpNorm<Eigen::Infinity>();
    return r > 0.6 && r < 2;
  });
  return frame;
}

TEST(Tear, CrumbsStayOnOrAreDroppedAndCounted) {
  Frame kept = crumb();
  const Torn held_on = tear(kept, keep);
  EXPECT_GT(held_on.vetoed, 0);
  EXPECT_GE(shape_of(kept).smallest_piece, 8);

  Frame dropped = crumb();
  set_turning(dropped);
  const double volume = test::volume_of(dropped);
  const Vector3 p = momentum(dropped);
  const Torn torn = tear(dropped, drop);
  EXPECT_GT(torn.dropped, 0);
  EXPECT_EQ(value_error(dropped), "");
  EXPECT_NEAR(test::volume_of(dropped) + number(dropped, "tear.volume", 0), volume, 1e-14);
  const auto account = dropped.find("tear.momentum")->values<double>();
  EXPECT_LT((3 * momentum(dropped) + Vector3(account[0], account[1], account[2]) - 3 * p).norm(), 1e-12);
  const Shape shape = shape_of(dropped);
  EXPECT_GE(shape.smallest_piece, 8);
  EXPECT_EQ(shape.isolated + shape.pinched, 0);
  std::vector<bool> used(dropped.vertices, false);
  for (const Corners& c : triangles(dropped))
    for (const std::uint32_t v : c)
      used[v] = true;
  EXPECT_EQ(std::ranges::count(used, false), 0);
}

TEST(Tear, HeldCrumbsAreNotDropped) {
  Frame frame = crumb();
  put_masks(frame, "touch")[4 * 9 + 4] = 1; // the crumb's middle
  tear(frame, drop);
  EXPECT_GE(std::ranges::count(masks(frame, "touch"), 1), 1);
  EXPECT_GE(shape_of(frame).smallest_piece, 8);
  frame = crumb();
  tear(frame, drop);
  const auto x = positions(static_cast<const Frame&>(frame));
  EXPECT_EQ(std::ranges::find(x, Vector3(4, 4, 0)), x.end());
}

TEST(Tear, WhatIsHeldByTheSameThingOrInTheInletStaysWhole) {
  const auto torn_edges = [](const Scene& scene, const char* array, std::uint64_t low, std::uint64_t high) {
    Frame frame = test::grid(9, 12, 1, thick);
    make_thin(frame, [](const Vector3& x) { return std::abs(x[1] - 6) < 1; });
    const auto bits = put_masks(frame, array);
    for (std::size_t v = 0; v < bits.size(); ++v)
      bits[v] = positions(frame)[v][1] < 5.5 ? low : high;
    formats::Array& origins =
        frame.put(formats::make_array("inlet_origin", formats::Place::vertex, formats::Type::float64, 3, "m",
                                      formats::Transfer::interpolate, frame.vertices));
    std::ranges::fill(origins.values<double>(), 0.0);
    return tear(frame, scene).edges;
  };
  const Scene held = tearing_scene("[[hold]]\nregion = {box = [[0,0,0],[1,1,1]]}\n[[hold]]\nregion = {box = "
                                   "[[0,0,0],[1,1,1]]}\nmotion = {kind = \"translating\", velocity = [0, 1, 0]}\n");
  EXPECT_EQ(torn_edges(held, "hold", 1, 1), 0);
  EXPECT_GT(torn_edges(held, "hold", 0, 0), 0);
  EXPECT_EQ(torn_edges(keep, "touch", 4, 4), 0);
  EXPECT_EQ(torn_edges(keep, "inlet", 1, 1), 0);
  // Sides that hold only one coordinate can part along it; so can a hold that has let go.
  const Scene guided = tearing_scene("[[hold]]\nregion = {box = [[0,0,0],[1,1,1]]}\naxes = \"z\"\n");
  EXPECT_GT(torn_edges(guided, "hold", 1, 1), 0);
  Scene late = held;
  late.holds[0].until = 0;
  EXPECT_GT(torn_edges(late, "hold", 1, 1), 0);
}

TEST(Tear, CrackTipsAndPathsThatMeetThemselves) {
  // A thin ring: the crack closes on itself, and what is inside is large enough to come off.
  Frame frame = test::grid(20, 20, 1, thick);
  make_thin(frame, [](const Vector3& x) {
    const double r = (x - Vector3(10, 10, 0)).norm();
    return r > 4 && r < 6;
  });
  tear(frame, keep);
  Shape shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 2);
  EXPECT_EQ(shape.isolated + shape.pinched + shape.touching, 0);
  // A thin line from the rim that ends inside.
  frame = test::grid(20, 20, 1, thick);
  make_thin(frame, [](const Vector3& x) { return x[0] < 10 && std::abs(x[1] - 10) < 1; });
  tear(frame, keep);
  shape = shape_of(frame);
  EXPECT_EQ(shape.pieces, 1);
  EXPECT_EQ(shape.pinched + shape.touching, 0);
}

TEST(Tear, BrokenMeshesAreRefused) {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<Corners> book{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, turned{{0, 1, 2}, {0, 1, 3}};
  for (const auto& corners : {book, turned}) {
    Frame frame = make_frame(x, corners, std::vector<double>(corners.size(), 1));
    EXPECT_THAT(error_of([&] { tear(frame, keep); }), HasSubstr("run along it in the same direction"));
  }
}

TEST(Tear, TrianglesWithoutAreaAreNotThin) {
  Frame frame = test::grid(6, 6, 1, thick);
  for (Vector3& x : positions(frame))
    x[1] = 0;
  EXPECT_EQ(tear(frame, keep).edges, 0);
}

TEST(Tear, TheSameAtAnyScale) {
  const auto run = [](double scale) {
    Frame frame = frame_of(test::disk(1, 8, 0.2));
    make_thin(frame, [](const Vector3& x) { return x[0] > -0.3 && x[0] < 0.25; });
    for (Vector3& x : positions(frame))
      x *= scale;
    for (double& v : volumes(frame))
      v *= scale * scale * scale;
    Scene scene = keep;
    *scene.tear->below *= scale;
    tear(frame, scene);
    return std::vector(triangles(frame).begin(), triangles(frame).end());
  };
  const auto one = run(1);
  EXPECT_EQ(one, run(0x1p-20)); // micrometres
  EXPECT_EQ(one, run(0x1p10));
}

// Any thickness anywhere.
TEST(Tear, RandomSheetsStayValid) {
  std::size_t cuts = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    Frame frame = frame_of(seed % 2 == 0 ? test::disk(1, 5, 0.25) : test::icosphere(2));
    const double part = uniform(random);
    for (double& v : volumes(frame))
      if (uniform(random) < part)
        v *= 0.3 * uniform(random) + 0.01;
    set_turning(frame);
    const Vector3 p = momentum(frame);
    const double volume = test::volume_of(frame);
    const Torn torn = tear(frame, seed % 3 == 0 ? drop : keep);
    cuts += torn.edges;
    ASSERT_EQ(value_error(frame), "") << seed;
    const Shape shape = shape_of(frame);
    EXPECT_EQ(shape.isolated, 0) << seed;
    EXPECT_EQ(shape.pinched, 0) << seed;
    EXPECT_EQ(shape.touching, 0) << seed;
    EXPECT_GE(shape.smallest_piece, 8) << seed;
    EXPECT_NEAR(test::volume_of(frame) + torn.volume, volume, 1e-14 * volume) << seed;
    EXPECT_LT((3 * momentum(frame) + torn.momentum - 3 * p).norm(), 1e-13) << seed;
    EXPECT_EQ(tear(frame, seed % 3 == 0 ? drop : keep).edges, 0) << seed;
  }
  EXPECT_GT(cuts, 1000);
}

} // namespace
} // namespace sheet::flow
