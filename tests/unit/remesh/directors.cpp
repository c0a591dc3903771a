// SPDX-License-Identifier: GPL-3.0-or-later
// What remeshing, tearing and inflow make of directors.
#include <map>

#include <gtest/gtest.h>

#include "libsheet/flow/emit.h"
#include "libsheet/flow/tear.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/sheet/directors.h"
#include "tests/support/meshes.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet {
namespace {

using formats::Frame;

constexpr double radius = 2;

Vector3 cylinder_normal(const Vector3& x) { return Vector3(x.x(), 0, x.z()).normalized(); }

// A patch of the cylinder about the y axis, its directors the cylinder's normals at the middles of the edges.
Frame bent() {
  test::Mesh mesh = test::rectangle(2, 1, 12, 6, 0.2);
  for (Vector3& x : mesh.positions)
    x = {radius * std::sin((x.x() - 1) / radius), x.y(), radius * std::cos((x.x() - 1) / radius)};
  Frame frame = make_frame(mesh.positions, mesh.triangles, std::vector<double>(mesh.triangles.size(), 1e-4));
  const Connectivity connected = connect(frame.vertices, triangles(frame));
  std::vector<Vector3> directors;
  for (const Edge& e : connected.edges)
    directors.push_back(cylinder_normal(mesh.positions[e[0]] + mesh.positions[e[1]]));
  put_directors(directors, connected, frame);
  return frame;
}

// By how much directors miss the cylinder's normals across their edges, root of the mean square.
double miss_of(const Frame& frame) {
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  const std::vector<Vector3> directors = directors_of(frame, mesh);
  EXPECT_EQ(directors.size(), mesh.edges.size());
  double error = 0;
  for (std::size_t e = 0; e < directors.size(); ++e) {
    const Vector3 a = positions(frame)[mesh.edges[e][0]], b = positions(frame)[mesh.edges[e][1]];
    const Vector3 t = (b - a).normalized(), n = cylinder_normal(a + b);
    error += (directors[e] - (n - n.dot(t) * t).normalized()).squaredNorm();
  }
  return std::sqrt(error / static_cast<double>(directors.size()));
}

std::string value_error(const Frame& frame) {
  const std::string form = formats::find_form_error(frame);
  return form.empty() ? formats::find_value_error(frame) : form;
}

TEST(Directors, StayThoseOfTheSurfaceWhereItIsRemeshed) {
  Frame frame = bent();
  EXPECT_LE(miss_of(frame), 1e-14);
  Frame forgotten = frame;
  put_director_angles({}, forgotten);
  EXPECT_EQ(forgotten.edges, 0);
  remesh::Options options;
  options.size.edge_length = 0.11;
  options.smooth = true;
  const std::uint64_t vertices = frame.vertices;
  (void)remesh::remesh(frame, nullptr, options);
  (void)remesh::remesh(forgotten, nullptr, options);
  ASSERT_GT(frame.vertices, vertices);
  EXPECT_EQ(forgotten.find("director_angle"), nullptr);
  EXPECT_EQ(value_error(frame), "");
  const double carried = miss_of(frame);
  const std::size_t edges = connect(frame.vertices, triangles(frame)).edges.size();
  put_director_angles(std::vector<double>(edges, 0), frame); // the mean normals
  EXPECT_LT(carried, 0.4 * miss_of(frame));
}

TEST(Directors, OfBothLipsOfATearAreTheOldOne) {
  Frame frame = bent();
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  std::map<std::pair<double, double>, Vector3> old; // by the edge's middle
  const auto middle = [](const Frame& f, const Edge& e) {
    const Vector3 m = 0.5 * (positions(f)[e[0]] + positions(f)[e[1]]);
    return std::pair(std::round(1e2 * m.x()), std::round(1e2 * m.y()));
  };
  const auto directors = directors_of(frame, mesh);
  for (std::size_t e = 0; e < directors.size(); ++e)
    old[middle(frame, mesh.edges[e])] = directors[e];
  for (std::size_t t = 0; t < frame.triangles; ++t) { // a thin stripe
    const double y = positions(frame)[triangles(frame)[t][0]].y();
    volumes(frame)[t] = (y > 0.4 && y < 0.6 ? 0.01 : 0.1) * test::area(frame, t);
  }
  const Scene scene = parse_scene("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.1\nthickness = 0.1\n"
                                  "[material]\nviscosity = 1\ndensity = 3\n[tear]\nbelow = 0.05\n",
                                  "scene");
  ASSERT_GT(flow::tear(frame, scene).vertices, 0);
  EXPECT_EQ(value_error(frame), "");
  const Connectivity torn = connect(frame.vertices, triangles(frame));
  ASSERT_GT(torn.edges.size(), mesh.edges.size());
  const auto after = directors_of(frame, torn);
  for (std::size_t e = 0; e < after.size(); ++e) {
    const auto known = old.find(middle(frame, torn.edges[e]));
    if (known != old.end()) { // the lips have moved a little
      EXPECT_LT((after[e] - known->second).norm(), 2e-3) << "edge " << e;
    }
  }
}

TEST(Directors, StayWhereLiquidFlowsIn) {
  Frame frame = test::grid(4, 2, 1, 0.25);
  const Scene scene = parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nsegments = [4, 2]\n"
                                  "pattern = \"structured\"\nthickness = 0.25\n[material]\nviscosity = 1\ndensity = 1\n"
                                  "[inflow]\nregion = \"z_max\"\nvelocity = [0, -1, 0]\n",
                                  "scene");
  const auto bits = put_masks(frame, "inlet");
  for (std::uint32_t v = 10; v < 15; ++v)
    bits[v] = in_inlet | at_inlet_border;
  formats::Array& origins =
      frame.put(formats::make_array("inlet_origin", formats::Place::vertex, formats::Type::float64, 3, "m",
                                    formats::Transfer::interpolate, frame.vertices));
  std::ranges::copy(positions(frame), origins.values<Vector3>().begin());
  const Connectivity mesh = connect(frame.vertices, triangles(frame));
  put_director_angles(std::vector<double>(mesh.edges.size(), 0.25), frame);
  for (Vector3& x : positions(frame))
    x.y() -= 2.2;
  frame.time = 2.2;
  ASSERT_GT(flow::emit(frame, scene).rows, 0);
  EXPECT_EQ(value_error(frame), "");
  const Connectivity longer = connect(frame.vertices, triangles(frame));
  const auto angles = frame.find("director_angle")->values<double>();
  ASSERT_EQ(angles.size(), longer.edges.size());
  std::size_t kept = 0, made = 0;
  for (std::size_t e = 0; e < angles.size(); ++e) {
    const auto [low, high] = longer.edges[e];
    if (high < 10) { // behind the inlet nothing has changed
      EXPECT_NEAR(angles[e], 0.25, 1e-12);
      ++kept;
    } else if (low >= 15) { // between new vertices: along the inlet's border as there or nothing is known
      EXPECT_LE(std::abs(angles[e]), 0.25 + 1e-12);
      made += angles[e] == 0;
    }
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(made, 0);
}

} // namespace
} // namespace sheet
