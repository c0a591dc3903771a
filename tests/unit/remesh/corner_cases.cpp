// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes that are hardly meshes: a right result or a clear error, never a hang.
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/measure/intersections.h"
#include "libsheet/remesh/operations.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/remesh/triangle_shape.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/consistency.h"
#include "tests/support/remesh/cycles.h"
#include "tests/support/remesh/flows.h"
#include "tests/support/remesh/options.h"

namespace sheet::remesh {
namespace {

using test::options;

formats::Frame frame_of(const std::vector<Vector3>& x, const std::vector<Corners>& t, double volume = 0.01) {
  return make_frame(x, t, std::vector<double>(t.size(), volume));
}

// Remeshes to fine and coarse lengths; volume stays, the result is a valid manifold of at least one triangle.
void expect_right(const formats::Frame& start, double edge_length) {
  const double volume = test::account_of(start).volume;
  for (const double factor : {0.3, 1.0, 4.0}) {
    formats::Frame frame = start;
    for (int i = 0; i < 3; ++i)
      static_cast<void>(remesh(frame, nullptr, options(factor * edge_length)));
    EXPECT_EQ(formats::find_form_error(frame), "");
    EXPECT_EQ(formats::find_value_error(frame), "") << factor;
    EXPECT_GE(frame.triangles, 1U);
    EXPECT_NEAR(test::account_of(frame).volume, volume, 1e-14 * volume) << factor;
    test::expect_consistent(Mesh(frame.vertices, triangles(std::as_const(frame))));
    for (const Vector3& x : positions(std::as_const(frame)))
      EXPECT_TRUE(x.allFinite());
  }
}

std::uint64_t holes(const formats::Frame& frame) {
  const Mesh mesh(frame.vertices, triangles(frame));
  std::set<std::uint32_t> seen;
  std::uint64_t loops = 0;
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v) {
    if (!mesh.on_rim(v) || seen.contains(v))
      continue;
    ++loops;
    for (std::uint32_t w = v; !seen.contains(w); w = mesh.to(mesh.side_at(w)))
      seen.insert(w);
  }
  return loops;
}

// A corner whose edge was split, all around a vertex of degree four: turning the edge opposite to the new vertex puts a
// triangle onto the two halves, from which they differ by round-off alone. Two vertices at one place were next.
TEST(CornerCase, NoFlipFoldsATriangleOntoItsNeighbours) {
  const Vector3 a(-1, 0.1, 0.3), b(1.1, 0, 0.2), middle = 0.5 * (a + b), tip(0, 1, 0), above(0, 0.5, 1);
  EditableSheet sheet(frame_of({a, b, middle, tip, above}, {{0, 2, 3}, {2, 1, 3}, {1, 4, 3}, {4, 0, 3}}));
  Edit edit;
  ASSERT_TRUE(propose_flip(sheet, sheet.mesh().find_side(3, 4), edit));
  const Limits limits = {.thickness = 100, .sharpest = 1, .facing = -1};
  EXPECT_FALSE(sheet.make(edit, limits));
  Limits lax = limits;
  lax.intersections = false;
  EXPECT_TRUE(sheet.make(edit, lax)); // nothing else stands against it
}

TEST(CornerCase, EmptyMesh) {
  formats::Frame frame = frame_of({}, {});
  EXPECT_EQ(remesh(frame, nullptr, options(0.1)).edits(), 0U);
}

TEST(CornerCase, OneTriangle) { expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), 1); }

TEST(CornerCase, TwoTriangles) {
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}), 1);
}

TEST(CornerCase, Tetrahedron) {
  const formats::Frame frame =
      frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  expect_right(frame, 1);
  formats::Frame coarse = frame; // nothing of it can go
  static_cast<void>(remesh(coarse, nullptr, options(10)));
  EXPECT_EQ(coarse.triangles, 4U);
}

TEST(CornerCase, Ear) {
  // a square with a triangle that hangs on one edge
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1.5, 0.5, 0}}, {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}),
               0.5);
}

TEST(CornerCase, Spike) {
  TriangleMesh mesh = make_disk(1, [] {
    MeshOptions o;
    o.edge_length = 0.3;
    return o;
  }());
  std::size_t middle = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (mesh.positions[v].norm() < mesh.positions[middle].norm())
      middle = v;
  mesh.positions[middle][2] += 3;
  expect_right(test::frame_of(mesh, 0.01), 0.3);
}

// What a pile has left at a rim, in mm: three triangles in a row from rim to rim, ever narrower.
formats::Frame tail() {
  return frame_of({{0.40, -0.18, -0.20},
                   {-1.34, 0.36, 0.37},
                   {-1.13, 0.24, 0.50},
                   {-0.82, 0.28, 0.26},
                   {-0.62, 0.19, 0.26},
                   {-0.27, 0.14, 0.11},
                   {-0.13, 0.04, 0.09}},
                  {{1, 3, 2}, {3, 5, 4}, {4, 2, 3}, {0, 6, 5}, {6, 4, 5}});
}

double least_angle(const formats::Frame& frame) {
  double sharpest = -1;
  const auto x = positions(frame);
  for (const Corners& c : triangles(frame))
    sharpest = std::max(sharpest, TriangleShape(x[c[0]], x[c[1]], x[c[2]]).sharpest);
  return std::acos(sharpest) * 180 / std::numbers::pi;
}

TEST(CornerCase, TensionDrawsATailIn) {
  Scene scene;
  formats::Frame frame = tail(), pointed = tail();
  const double volume = test::account_of(frame).volume;
  static_cast<void>(remesh(pointed, &scene, options(1.5)));
  EXPECT_LT(least_angle(pointed), 10); // somebody's shape, it may be
  scene.material.surface_tension = 0.05;
  static_cast<void>(remesh(frame, &scene, options(1.5)));
  EXPECT_GT(least_angle(frame), 15);
  EXPECT_NEAR(test::account_of(frame).volume, volume, 1e-14 * volume);
  test::expect_consistent(Mesh(frame.vertices, triangles(std::as_const(frame))));
}

// A square's rim with an ear of one triangle, which lies folded back over it. Its blunt tip touches a solid, so no
// collapse takes it away, as the square's corners insist on their places, too.
TEST(CornerCase, AnEarIsTrimmed) {
  formats::Frame frame =
      frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.05, 0.11}}, {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}});
  put_masks(frame, "touch")[4] = 1;
  static_cast<void>(remesh(frame, nullptr, options(1.1)));
  EXPECT_EQ(frame.triangles, 2U);
  EXPECT_GT(least_angle(frame), 44);
}

// A fan of four around 4; without 0 4 1, whose side 0 1 is the rim's, 4 comes to be on the rim.
TEST(CornerCase, TrimsOfRims) {
  const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.05, 0}};
  EditableSheet sheet(frame_of(x, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  const Limits limits = {.thickness = 3, .sharpest = 1, .facing = -1};
  Edit edit;
  ASSERT_TRUE(propose_trim(sheet, 0, edit));
  ASSERT_TRUE(sheet.make(edit, limits));
  EXPECT_TRUE(sheet.mesh().on_rim(4));
  EXPECT_EQ(sheet.mesh().triangle_count(), 3U);
  const auto at = [&](std::uint32_t from, std::uint32_t to) {
    return Mesh::triangle_of(sheet.mesh().find_side(from, to));
  };
  EXPECT_NEAR(sheet.volume(at(1, 2)), 0.015, 1e-15); // two neighbours of one size share what it had
  test::expect_consistent(sheet.mesh());
  EXPECT_FALSE(propose_trim(sheet, at(2, 3), edit)); // the sheet would hang by 4
  ASSERT_TRUE(propose_trim(sheet, at(1, 2), edit));  // a tip
  ASSERT_TRUE(sheet.make(edit, limits));
  EXPECT_FALSE(sheet.mesh().has_vertex(1));
  test::expect_consistent(sheet.mesh());
  const formats::Frame one = frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_FALSE(propose_trim(EditableSheet(one), 0, edit)); // no neighbour takes its liquid
}

// A fan of five around 0, open by an angle between the first and the last vertex around it.
formats::Frame open_fan(double degrees) {
  std::vector<Vector3> x = {{0, 0, 0}};
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double angle = (degrees / 2 + i * (360 - degrees) / 5) * std::numbers::pi / 180;
    x.emplace_back(std::cos(angle), std::sin(angle), 0);
    if (i > 0)
      t.push_back({0, i, i + 1});
  }
  formats::Frame frame = frame_of(x, t);
  std::ranges::fill(put_masks(frame, "touch"), 1);
  put_masks(frame, "inlet")[1] = 1;
  return frame;
}

// What is split between vertices on two solids along which it flows is on one of them; where it sticks, on neither.
TEST(CornerCase, WhatIsNewBetweenTwoWallsIsOnOne) {
  Scene scene;
  scene.solids.resize(2);
  for (scene::Solid& solid : scene.solids)
    solid.shape = scene::HalfSpace{{0, 0, 1}};
  const auto touch_of_new = [&] {
    formats::Frame frame = frame_of({{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}, {0.5, -0.8, 0}}, {{0, 1, 2}, {1, 0, 3}});
    const std::span<std::uint64_t> touch = put_masks(frame, "touch");
    std::ranges::fill(touch, 1);
    touch[1] = 2;
    EditableSheet sheet(frame, &scene);
    Edit edit;
    std::uint32_t side = 0;
    while (sheet.mesh().from(side) + sheet.mesh().to(side) != 1)
      ++side;
    propose_split(sheet, side, edit);
    EXPECT_TRUE(sheet.make(edit, {.thickness = 1.3, .sharpest = 1, .facing = 0.3}));
    sheet.put(frame);
    return masks(frame, "touch")[4];
  };
  EXPECT_EQ(touch_of_new(), 0U);
  for (scene::Solid& solid : scene.solids)
    solid.contact = SolidContact::flow;
  EXPECT_TRUE(touch_of_new() == 1U || touch_of_new() == 2U);
}

// Where the liquid flows along a wall, beside an inlet or as its ends come together, if it is narrower than edges are
// long, and no blunt corner.
TEST(CornerCase, ANotchOfARimOnAWallIsFilled) {
  Scene scene;
  scene.solids.resize(1);
  scene.solids[0].shape = scene::HalfSpace{{0, 0, 1}};
  const auto triangles_of = [&](double degrees, double edge_length) {
    formats::Frame frame = open_fan(degrees);
    static_cast<void>(remesh(frame, &scene, options(edge_length)));
    EXPECT_NEAR(test::account_of(frame).volume, 0.05, 1e-16);
    test::expect_consistent(Mesh(frame.vertices, triangles(std::as_const(frame))));
    return frame.triangles;
  };
  EXPECT_EQ(triangles_of(50, 1), 5U); // what sticks
  scene.solids[0].contact = SolidContact::flow;
  EXPECT_EQ(triangles_of(50, 1), 6U);
  EXPECT_EQ(triangles_of(100, 1), 5U);
  Edit edit;
  formats::Frame away = open_fan(50);
  put_masks(away, "inlet")[1] = 0;
  EXPECT_FALSE(propose_fill(EditableSheet(away, &scene), 0, edit)); // at rest
  const std::span<Vector3> velocity = velocities(away);
  velocity[1] = {0, 0.1, 0}; // its ends part
  EXPECT_FALSE(propose_fill(EditableSheet(away, &scene), 0, edit));
  velocity[1] = {0, -0.1, 0}; // they meet
  EXPECT_TRUE(propose_fill(EditableSheet(away, &scene), 0, edit));
  put_masks(away, "touch")[6] = 2; // something stands between them
  EXPECT_FALSE(propose_fill(EditableSheet(away, &scene), 0, edit));
  EditableSheet sheet(open_fan(50), &scene);
  ASSERT_TRUE(propose_fill(sheet, 0, edit));
  ASSERT_TRUE(sheet.make(edit, {.thickness = 1.3, .sharpest = 1, .facing = 0.5}));
  EXPECT_FALSE(sheet.mesh().on_rim(0));
  EXPECT_FALSE(propose_fill(sheet, 0, edit));
  const double area = (5 * std::sin(62 * std::numbers::pi / 180) + std::sin(50 * std::numbers::pi / 180)) / 2;
  for (std::uint32_t t = 0; t < 6; ++t) // as thick everywhere, thinner than before
    EXPECT_NEAR(sheet.volume(t) / sheet.shape(t).area, 0.05 / area, 1e-12);
}

// A flat ear whose tip touches another solid, without surface tension: of what sticks it may be somebody's shape, of
// what flows along walls it is not.
TEST(CornerCase, AnEarOnAWallIsTrimmed) {
  Scene scene;
  scene.solids.resize(2);
  const auto triangles_of = [&](SolidContact contact) {
    for (scene::Solid& solid : scene.solids)
      solid.contact = contact;
    formats::Frame frame =
        frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1.1, -0.15, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}});
    const std::span<std::uint64_t> touch = put_masks(frame, "touch");
    std::ranges::fill(touch, 1);
    touch[4] = 2;
    static_cast<void>(remesh(frame, &scene, options(1.1)));
    return frame.triangles;
  };
  EXPECT_EQ(triangles_of(SolidContact::stick), 3U);
  EXPECT_EQ(triangles_of(SolidContact::flow), 2U);
}

TEST(CornerCase, StripOneTriangleWide) {
  std::vector<Vector3> x;
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i <= 20; ++i) {
    x.emplace_back(0.1 * i, 0, 0);
    x.emplace_back(0.1 * i, 0.1, 0);
    if (i > 0) {
      t.push_back({2 * i - 2, 2 * i, 2 * i + 1});
      t.push_back({2 * i - 2, 2 * i + 1, 2 * i - 1});
    }
  }
  expect_right(frame_of(x, t), 0.1);
  formats::Frame frame = frame_of(x, t); // it must not be eaten from its ends
  static_cast<void>(remesh(frame, nullptr, options(0.4)));
  double low = 1, high = 0;
  for (const Vector3& p : positions(std::as_const(frame))) {
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  }
  EXPECT_NEAR(high - low, 2, 0.1);
}

TEST(CornerCase, BowTieIsAnError) {
  formats::Frame frame = frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  try {
    static_cast<void>(remesh(frame, nullptr, options(1)));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(error.what()).find("vertex 0"), std::string::npos);
  }
}

TEST(CornerCase, AnnulusWithAHoleOfThreeEdges) {
  // the hole's corners turn by more than 45 degrees, so it stays, however coarse the mesh
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.2;
  TriangleMesh mesh = make_disk(1, mesh_options);
  std::size_t middle = 0;
  const auto distance = [&](std::size_t t) {
    const TriangleIndices& c = mesh.triangles[t];
    return (mesh.positions[c[0]] + mesh.positions[c[1]] + mesh.positions[c[2]]).norm();
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (distance(t) < distance(middle))
      middle = t;
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(middle));
  const formats::Frame frame = test::frame_of(mesh, 0.01);
  ASSERT_EQ(holes(frame), 2U);
  expect_right(frame, 0.2);
  formats::Frame coarse = frame;
  static_cast<void>(remesh(coarse, nullptr, options(0.8)));
  EXPECT_EQ(holes(coarse), 2U);
}

TEST(CornerCase, ClosedAndOpenComponentsTogether) {
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.2;
  TriangleMesh mesh = make_sphere(0.5, mesh_options);
  const TriangleMesh other = make_rectangle(1, 1, mesh_options);
  mesh = test::joined(mesh, other, Vector3(0, 0, 2));
  const formats::Frame frame = test::frame_of(mesh, 0.01);
  expect_right(frame, 0.2);
  EXPECT_EQ(holes(frame), 1U);
}

TEST(CornerCase, DuplicateVertices) {
  // an edge without length in the middle of a square
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 0}},
                        {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {3, 0, 4}}),
               0.5);
}

TEST(CornerCase, TriangleWithoutArea) {
  // vertex 4 lies on the edge 0-2
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                        {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {4, 2, 3}}),
               0.7);
}

TEST(CornerCase, InvertedTriangle) {
  // vertex 4 is drawn over the edge 0-1: that triangle lies upside down on the others
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -0.2, 0}},
                        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}),
               0.7);
}

TEST(CornerCase, ThicknessContrastOfAMillion) {
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.2;
  formats::Frame frame = test::frame_of(make_disk(1, mesh_options), 0.01);
  for (std::size_t t = 0; t < frame.triangles; t += 2)
    volumes(frame)[t] *= 1e-6;
  expect_right(frame, 0.2);
  static_cast<void>(remesh(frame, nullptr, options(0.1)));
  const test::Account now = test::account_of(frame);
  EXPECT_GT(now.thickness_min, 1e-8 * 0.9);
  EXPECT_LT(now.thickness_max, 1e-2 * 1.1);
}

TEST(CornerCase, CollinearCaps) {
  // many points on one line: triangles of almost no height along an edge
  std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  std::vector<Corners> t;
  for (int i = 1; i < 10; ++i)
    x.emplace_back(0.1 * i, 1e-9 * i * (10 - i), 0);
  t.push_back({0, 1, 3});
  for (std::uint32_t i = 3; i < 11; ++i) {
    t.push_back({i, 1, i + 1});
    t.push_back({i, i + 1, 2});
  }
  t.push_back({0, 3, 2});
  t.push_back({11, 1, 2});
  const formats::Frame frame = frame_of(x, t, 1e-12);
  expect_right(frame, 0.3);
  formats::Frame good = frame;
  for (int i = 0; i < 3; ++i)
    static_cast<void>(remesh(good, nullptr, options(0.3)));
  EXPECT_GT(test::angles_of(good, 0.3).smallest, 15);
}

// The first triangle is an inlet's strip, which stays as it is. The one beside it was once halved towards their long
// edge until it had no area.
TEST(CornerCase, LongEdgeThatMayNotBeSplit) {
  formats::Frame frame = frame_of({{0, 0, 0}, {2.7, 0, 0}, {1.35, -1, 0}, {1.35, 0.9, 0}}, {{0, 2, 1}, {0, 1, 3}});
  formats::Array inlet = formats::make_array("inlet", formats::Place::vertex, formats::Type::uint64, 1, "1",
                                             formats::Transfer::common, frame.vertices);
  for (std::size_t v = 0; v < 3; ++v)
    inlet.values<std::uint64_t>()[v] = 4;
  frame.put(std::move(inlet));
  const Report report = remesh(frame, nullptr, options(1));
  EXPECT_LE(report.splits, 2U);
  const auto x = positions(frame);
  for (const Corners& t : triangles(frame))
    EXPECT_LT(TriangleShape(x[t[0]], x[t[1]], x[t[2]]).sharpest, cosine_of_degrees(10));
}

TEST(CornerCase, InnerVertexOfDegreeThree) {
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.3, 0}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}), 0.6);
}

// A triangle of a plate with a vertex in its middle, raised: a spike goes and its liquid stays, a dent of the plate's
// curvature stays too.
TEST(CornerCase, SteepPocketsAreClosed) {
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.2;
  for (const double height : {0.02, 0.24}) {
    TriangleMesh mesh = make_rectangle(1, 1, mesh_options);
    const TriangleIndices t = mesh.triangles[mesh.triangles.size() / 2];
    const Vector3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(middle + height * Vector3::UnitZ());
    mesh.triangles[mesh.triangles.size() / 2] = {t[0], t[1], tip};
    mesh.triangles.push_back({t[1], t[2], tip});
    mesh.triangles.push_back({t[2], t[0], tip});
    formats::Frame frame = test::frame_of(mesh, 0.01);
    const double volume = test::account_of(frame).volume;
    EditableSheet sheet(frame);
    Edit edit;
    ASSERT_TRUE(propose_removal(sheet, tip, edit));
    const TriangleShape base(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
    EXPECT_NEAR(edit.swept, -height * base.area / 3 * base.normal.z(), 1e-15); // the cone's
    static_cast<void>(remesh(frame, nullptr, options(0.2)));
    double highest = 0;
    for (const Vector3& x : positions(std::as_const(frame)))
      highest = std::max(highest, x.z());
    EXPECT_EQ(highest<1e-3, height> 0.2);
    EXPECT_NEAR(test::account_of(frame).volume, volume, 1e-14 * volume);
    test::expect_consistent(Mesh(frame.vertices, triangles(std::as_const(frame))));
  }
}

// A rim vertex that liquid presses against the end of an inlet goes to that end: the inlet's strip there stays as it
// is.
TEST(CornerCase, WhatIsPressedAgainstAnInletsEndGoesThere) {
  // The strip 0 1 2, 1 3 2 comes from the left; 4 and 5 lie beside its end.
  const std::vector<Vector3> x = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {1.001, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  formats::Frame frame = frame_of(x, {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {4, 5, 3}, {3, 5, 6}});
  const auto bits = put_masks(frame, "inlet");
  for (std::size_t v = 0; v < 4; ++v)
    bits[v] = in_inlet;
  EditableSheet sheet(frame);
  Edit edit;
  ASSERT_TRUE(propose_collapse(sheet, sheet.mesh().find_side(2, 4), 0, edit));
  EXPECT_EQ(edit.vertex, 2U);
  EXPECT_TRUE(sheet.make(edit, {.thickness = 100, .sharpest = 1, .facing = -1}));
  EXPECT_EQ(sheet.at(2), x[2]);
}

TEST(CornerCase, OppositeEdgeExists) {
  // Turning 0-1 would make a second edge 2-3: a tetrahedron without one face.
  expect_right(frame_of({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.4, 0.01}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}}), 0.6);
}

TEST(CornerCase, ConcaveRim) {
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.1;
  TriangleMesh mesh = make_rectangle(1, 1, mesh_options);
  std::erase_if(mesh.triangles, [&](const TriangleIndices& t) { // an L
    const Vector3 c = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
    return c[0] > 0 && c[1] > 0;
  });
  std::vector<std::uint32_t> number(mesh.positions.size(), no_index);
  std::vector<Vector3> used;
  for (TriangleIndices& t : mesh.triangles)
    for (std::uint32_t& v : t) {
      if (number[v] == no_index) {
        number[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
  mesh.positions = used;
  expect_right(test::frame_of(mesh, 0.01), 0.1);
}

TEST(CornerCase, CoplanarSheetsThatTouch) {
  // Two squares side by side, meeting in an edge without sharing it: they touch before and after; remeshing must end.
  MeshOptions mesh_options;
  mesh_options.edge_length = 0.2;
  TriangleMesh mesh = make_rectangle(1, 1, mesh_options);
  const TriangleMesh other = mesh;
  mesh = test::joined(mesh, other, Vector3(1, 0, 0));
  expect_right(test::frame_of(mesh, 0.01), 0.2);
}

TEST(CornerCase, UpperBoundBelowTwiceTheLowerIsAnError) {
  formats::Frame frame = frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  Options o = options(1);
  o.size.chord_error = 0.01;
  o.size.min_edge = 1;
  o.size.max_edge = 1.5;
  try {
    static_cast<void>(remesh(frame, nullptr, o));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("--max-edge"), std::string::npos);
  }
}

TEST(CornerCase, ImpossibleLengthsAreErrors) {
  const formats::Frame frame = frame_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const double length : {0.0, -1.0, std::nan(""), static_cast<double>(INFINITY), 1e-9}) {
    formats::Frame work = frame;
    EXPECT_THROW(static_cast<void>(remesh(work, nullptr, options(length))), Error) << length;
    EXPECT_TRUE(work == frame);
  }
}

TEST(CornerCase, BudgetReachedIsToldAndTheNextCallGoesOn) {
  // An edge that no triangle's area shows: a needle 1000 long and 1e-6 wide.
  formats::Frame frame = frame_of({{0, 0, 0}, {1000, 0, 0}, {1000, 1e-6, 0}}, {{0, 1, 2}}, 1e-9);
  const Report first = remesh(frame, nullptr, options(0.1));
  EXPECT_TRUE(first.budget_reached);
  const std::uint64_t triangles_then = frame.triangles;
  static_cast<void>(remesh(frame, nullptr, options(0.1)));
  EXPECT_GT(frame.triangles, triangles_then);
}

} // namespace
} // namespace sheet::remesh
