// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow strips: how wide they are, and that their triangles stay good while they are drawn out; sheets thicker than
// their edges are long.
#include "libsheet/remesh/strip_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/remesh/necks.h"
#include "libsheet/remesh/size_field.h"
#include "libsheet/scene/read.h"
#include "libsheet/shape/shapes.h"
#include "libsheet/sheet/sheet.h"
#include "tests/support/remesh/flows.h"
#include "tests/support/remesh/options.h"

namespace sheet::remesh {
namespace {

using test::edges;
using test::options;

constexpr double strip_edge = 0.1;

formats::Frame ribbon(double length, double width, double edge, double thickness = 0.001) {
  return test::frame_of(make_rectangle(length, width, edges(edge)), thickness);
}

void hold_ends(formats::Frame& frame, double half) {
  formats::Array hold = formats::make_array("hold", formats::Place::vertex, formats::Type::uint64, 1, "1",
                                            formats::Transfer::common, frame.vertices);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    hold.values<std::uint64_t>()[v] = std::abs(positions(std::as_const(frame))[v].x()) > half - 1e-9 ? 1 : 0;
  frame.put(std::move(hold));
}

TEST(StripWidth, IsTheHeightOfARowOfTrianglesAndInfiniteInASheet) {
  const formats::Frame narrow = ribbon(1, 0.07, 0.07);
  const std::vector<double> width = strip_widths(EditableSheet(narrow));
  for (std::size_t v = 0; v < narrow.vertices; ++v)
    if (std::abs(positions(narrow)[v].x()) < 0.4) {
      EXPECT_NEAR(width[v], 0.07, 1e-12);
    }
  const formats::Frame disk = test::frame_of(make_disk(1, edges(0.1)), 0.001);
  for (const double w : strip_widths(EditableSheet(disk)))
    EXPECT_EQ(w, std::numeric_limits<double>::infinity());
}

// A wedge of 10 degrees, one row of triangles.
TEST(StripWidth, ASharpEndIsAWedgeOrTheEndOfAStrip) {
  TriangleMesh mesh;
  const double opening = std::tan(10 * std::numbers::pi / 180);
  mesh.positions = {{0, 0, 0}};
  for (std::uint32_t i = 1; i <= 8; ++i) {
    mesh.positions.emplace_back(0.1 * i, 0, 0);
    mesh.positions.emplace_back(0.1 * i, 0.1 * i * opening, 0);
  }
  mesh.triangles = {{0, 1, 2}};
  for (std::uint32_t i = 1; i < 8; ++i) {
    const std::uint32_t a = 2 * i - 1;
    mesh.triangles.push_back({a, a + 2, a + 1});
    mesh.triangles.push_back({a + 1, a + 2, a + 3});
  }
  const EditableSheet sheet(test::frame_of(mesh, 0.001));
  EXPECT_EQ(strip_widths(sheet)[5], std::numeric_limits<double>::infinity());
  EXPECT_LT(strip_widths(sheet, std::numbers::pi / 9)[5], 0.1);
  mesh.positions[1] = mesh.positions[0]; // a corner that has run together, from which there is no way to the next
  EXPECT_EQ(strip_widths(EditableSheet(test::frame_of(mesh, 0.001))).size(), mesh.positions.size());
}

// A strand that turns and comes back beside its other end, a wedge of 30 degrees: only what lies behind the tip along
// the sheet is the wedge's.
TEST(StripWidth, AStrandThatPassesATipIsNoWedge) {
  constexpr std::uint32_t rows = 6;
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}};
  for (std::uint32_t i = 1; i <= rows; ++i) { // from the tip to x = 0.6, opening to a width of 0.1
    const double x = 0.1 * i, half = std::min(x * std::tan(std::numbers::pi / 12), 0.05);
    mesh.positions.insert(mesh.positions.end(), {{x, -half, 0}, {x, half, 0}});
  }
  for (std::uint32_t i = 1; i < rows; ++i) { // round
    const double angle = std::numbers::pi * (i / 6.0 - 0.5);
    const Vector3 out(std::cos(angle), std::sin(angle), 0), center(0.6, 0.1, 0);
    mesh.positions.insert(mesh.positions.end(), {center + 0.15 * out, center + 0.05 * out});
  }
  for (std::uint32_t i = 0; i <= rows; ++i) // and back
    mesh.positions.insert(mesh.positions.end(), {{0.6 - 0.1 * i, 0.25, 0}, {0.6 - 0.1 * i, 0.15, 0}});
  mesh.triangles = {{0, 1, 2}};
  for (std::uint32_t a = 1; a + 3 < mesh.positions.size(); a += 2) {
    mesh.triangles.push_back({a, a + 2, a + 1});
    mesh.triangles.push_back({a + 1, a + 2, a + 3});
  }
  const std::vector<double> width = strip_widths(EditableSheet(test::frame_of(mesh, 0.001)));
  EXPECT_EQ(width[2], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(width[width.size() - 3], 0.1, 1e-12); // at x = 0.1, which is nearer to the tip than the turn
}

// Two rows, of a fifth and a tenth of an edge: an inner vertex has their sum.
TEST(StripWidth, IsMeasuredAcrossTwoRows) {
  TriangleMesh mesh;
  for (const double y : {0.0, 0.02, 0.03})
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back(0.1 * i, y, 0);
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t i = 0; i < 7; ++i) {
      const std::uint32_t a = 8 * row + i;
      mesh.triangles.push_back({a, a + 1, a + 8});
      mesh.triangles.push_back({a + 1, a + 9, a + 8});
    }
  formats::Frame frame = test::frame_of(mesh, 0.001);
  const std::vector<double> width = strip_widths(EditableSheet(frame));
  for (const std::size_t v : {3, 11, 19})
    EXPECT_NEAR(width[v], 0.03, 1e-12) << v;
  for (int i = 0; i < 3; ++i)
    static_cast<void>(remesh(frame, nullptr, options(strip_edge)));
  EXPECT_GT(test::angles_of(frame, strip_edge).smallest, 15);
}

// One edge wide, between clamps and free, to a twentieth of its width.
TEST(StripWidth, ADrawnRibbonKeepsGoodTriangles) {
  constexpr double length = 8 * strip_edge;
  const auto drawn = [](const Vector3& x, double t) {
    const double s = x[0] / (length / 2 * std::exp(t));
    return Vector3(x[0], -x[1] * std::max(0.0, 1 - s * s), 0);
  };
  test::Flow free{"free", ribbon(length, strip_edge, strip_edge), strip_edge, std::log(20.0),
                  [](const Vector3& x, double) { return Vector3(x[0] / 2, -x[1], 0); }};
  test::Flow clamped{"clamped", ribbon(length, strip_edge, strip_edge), strip_edge, std::log(20.0), drawn};
  hold_ends(clamped.start, length / 2);
  for (const test::Flow& flow : {free, clamped}) {
    const test::FlowResult r = test::run_flow(flow, 0.1, options(strip_edge));
    EXPECT_GT(r.worst.smallest, 15) << flow.name;
    EXPECT_LT(r.volume_error, 1e-13) << flow.name;
  }
}

// Where tension rounds it: a strand of two rows, as thick as wide, becomes one of one row, whatever edges are asked
// for; one that is thinner than wide does not, nor does a piece that is hardly longer than it is wide, nor without
// faces.
TEST(StripWidth, RoundThreadsGetOneRow) {
  constexpr double width = 0.1, round = 4 / std::numbers::pi * width;
  MeshOptions two_rows = edges(0.58 * width);
  two_rows.pattern = Pattern::equilateral;
  const auto inner = [&](double length, double thickness, bool faces) {
    const Scene scene = parse_scene(
        fmt::format("[sheet]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 1\nthickness = 1\n[material]\n"
                    "viscosity = 1\nsurface_tension = 1\n[model]\ninertia = false\nfaces = {}\n",
                    faces),
        "scene");
    formats::Frame frame = test::frame_of(make_rectangle(length, width, two_rows), thickness);
    for (int i = 0; i < 3; ++i)
      static_cast<void>(remesh(frame, &scene, options(width / 2)));
    EXPECT_GT(test::angles_of(frame, width).smallest, 15);
    const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
    std::set<std::uint32_t> on_rim;
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e)
      if (mesh.on_rim(e))
        on_rim.insert(mesh.edges[e].begin(), mesh.edges[e].end());
    return frame.vertices - on_rim.size();
  };
  EXPECT_LT(inner(20 * width, round, true), 4U); // at its ends
  EXPECT_GT(inner(20 * width, 0.5 * width, true), 20U);
  EXPECT_GT(inner(20 * width, round, false), 20U);
  EXPECT_GT(inner(2 * width, round, true), 0U);
}

// Slivers that are there already: a ribbon a fifth as wide as its edges are long.
TEST(StripWidth, SliversOfAStripAreMended) {
  formats::Frame frame = ribbon(20 * strip_edge, strip_edge, strip_edge);
  for (Vector3& x : positions(frame))
    x = {2 * x.x(), 0.1 * x.y(), 0};
  ASSERT_LT(test::angles_of(frame, strip_edge).smallest, 4);
  for (int i = 0; i < 3; ++i)
    static_cast<void>(remesh(frame, nullptr, options(strip_edge)));
  EXPECT_GT(test::angles_of(frame, strip_edge).smallest, 15);
}

// A thick strip is cut no finer than it is thick, and a coarse mesh of it stays.
TEST(StripWidth, TrianglesAreNoFinerThanTheSheetIsThick) {
  for (const double width : {2 * strip_edge, 8 * strip_edge}) {
    formats::Frame frame = ribbon(20 * strip_edge, width, 2 * strip_edge, 2.5 * strip_edge);
    const std::uint64_t before = frame.vertices;
    static_cast<void>(remesh(frame, nullptr, options(strip_edge)));
    EXPECT_LE(frame.vertices, before) << width;
    formats::Frame thin = ribbon(20 * strip_edge, width, 2 * strip_edge, 0.5 * strip_edge);
    static_cast<void>(remesh(thin, nullptr, options(strip_edge)));
    EXPECT_GT(thin.vertices, 2 * before) << width;
  }
}

// On a wall along which it flows, a deep layer gets edges of half its thickness; on one that it sticks to, none but
// those that are asked for.
TEST(StripWidth, ADeepLayerOnAWallHasEdgesOfHalfItsThickness) {
  Scene scene;
  scene.solids.resize(1);
  for (const auto contact : {SolidContact::flow, SolidContact::stick}) {
    scene.solids[0].contact = contact;
    formats::Frame frame = ribbon(40 * strip_edge, 40 * strip_edge, strip_edge, 5 * strip_edge);
    std::ranges::fill(put_masks(frame, "touch"), 1);
    static_cast<void>(remesh(frame, &scene, options(strip_edge)));
    const EditableSheet sheet(frame);
    double sum = 0;
    for (const Edge& e : connect(frame.vertices, triangles(frame)).edges)
      sum += (sheet.at(e[0]) - sheet.at(e[1])).norm();
    const double mean = sum / static_cast<double>(connect(frame.vertices, triangles(frame)).edges.size());
    if (contact == SolidContact::flow)
      EXPECT_GT(mean, 2 * strip_edge);
    else
      EXPECT_LT(mean, 1.3 * strip_edge);
  }
}

// Beside a thin sheet with edges as short as its folds need, for which the longest edge is asked for.
TEST(StripWidth, TrianglesOfAdaptiveLengthsAreNoFinerThanTheSheetIsThick) {
  Options adaptive = options(strip_edge);
  adaptive.size.chord_error = 0.1 * strip_edge;
  adaptive.size.min_edge = 0.5 * strip_edge;
  adaptive.size.max_edge = strip_edge;
  formats::Frame frame = ribbon(20 * strip_edge, 8 * strip_edge, 2 * strip_edge, 2.5 * strip_edge);
  const std::uint64_t before = frame.vertices;
  static_cast<void>(remesh(frame, nullptr, adaptive));
  EXPECT_LE(frame.vertices, before);
  formats::Frame thin = ribbon(20 * strip_edge, 8 * strip_edge, 2 * strip_edge, 0.5 * strip_edge);
  static_cast<void>(remesh(thin, nullptr, adaptive));
  EXPECT_GT(thin.vertices, 2 * before);
}

// A tube of three edges around, narrowest in the middle, of which its ring number k has the vertices 3k to 3k + 2.
formats::Frame narrowing_tube(int rings) {
  TriangleMesh mesh;
  for (int k = 0; k < rings; ++k)
    for (int i = 0; i < 3; ++i) {
      const double angle = 2 * std::numbers::pi / 3 * i, radius = 0.02 * (1 + std::pow(2.0 * k / (rings - 1) - 1, 2));
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.1 * k);
    }
  for (std::uint32_t k = 0; k + 1 < static_cast<std::uint32_t>(rings); ++k)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = 3 * k + i, b = 3 * k + (i + 1) % 3;
      mesh.triangles.push_back({a, b, b + 3});
      mesh.triangles.push_back({a, b + 3, a + 3});
    }
  return test::frame_of(mesh, 0.001);
}

// A tube of three edges around: a neck is where enough of it is on either side; none where it is wider than asked for,
// or where its ends are near.
TEST(StripWidth, ANeckIsAsWideAsTheEdgesRoundIt) {
  constexpr int rings = 13;
  formats::Frame frame = narrowing_tube(rings);
  const std::vector<double> width = neck_widths(EditableSheet(frame), 0.05);
  for (std::uint32_t k = 0; k < rings; ++k) // 36 triangles on either side of the sixth alone
    for (std::uint32_t v = 3 * k; v < 3 * k + 3; ++v)
      if (k == 6)
        EXPECT_NEAR(width[v], 0.02 * std::sqrt(3.0), 1e-12);
      else
        EXPECT_EQ(width[v], std::numeric_limits<double>::infinity());
  for (const double w : neck_widths(EditableSheet(frame), 0.03))
    EXPECT_EQ(w, std::numeric_limits<double>::infinity());
  for (const double w : neck_widths(EditableSheet(narrowing_tube(10)), 0.05))
    EXPECT_EQ(w, std::numeric_limits<double>::infinity());
}

// Edges of twice a neck's width; where it carries next to nothing longer ones: a triangle of half its width by an edge
// carries a hundredth of the mean then.
TEST(StripWidth, ANeckThatCarriesNothingGetsLongEdges) {
  formats::Frame frame = narrowing_tube(13);
  const auto wanted = [&] {
    EditableSheet sheet(frame);
    SizeOptions options;
    options.edge_length = 0.1;
    return SizeField(sheet, nullptr, options).at(3 * 6);
  };
  const double width = 0.02 * std::sqrt(3.0);
  EXPECT_NEAR(wanted(), 2 * width, 1e-12);
  const auto volume = volumes(frame);
  const auto thin_middle = [&](double part) {
    for (std::size_t t = 6 * 5; t < 6 * 7; ++t) // before and behind ring 6
      volume[t] *= part;
  };
  thin_middle(0.02);
  EXPECT_NEAR(wanted(), 2 * width, 1e-12);
  thin_middle(0.7);
  const double mean = std::accumulate(volume.begin(), volume.end(), 0.0) / static_cast<double>(volume.size());
  EXPECT_NEAR(wanted(), 2 * 0.01 * mean / (width * 1.4e-5), 0.01 * wanted());
  EXPECT_GT(wanted(), 2.2 * width);
  EXPECT_LT(wanted(), 0.1);
}

} // namespace
} // namespace sheet::remesh
