// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/shapes.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/shape/mesh_measure.h"

namespace sheet {
namespace {

constexpr double pi = std::numbers::pi, degree = pi / 180.0;

struct Shape {
  const char* name;
  std::function<TriangleMesh(const MeshOptions&)> make;
  double area;
  long euler;
  double rim_length;
};

std::vector<Shape> all_shapes() {
  return {
      {"rectangle", [](const MeshOptions& o) { return make_rectangle(2.0, 1.3, o); }, 2.6, 1, 6.6},
      {"disk", [](const MeshOptions& o) { return make_disk(1.0, o); }, pi, 1, 2 * pi},
      {"annulus", [](const MeshOptions& o) { return make_annulus(0.4, 1.0, o); }, 0.84 * pi, 0, 2.8 * pi},
      {"sphere", [](const MeshOptions& o) { return make_sphere(1.0, o); }, 4 * pi, 2, 0.0},
      {"cap", [](const MeshOptions& o) { return make_cap(1.0, pi / 3, o); }, pi, 1, 2 * pi * std::sin(pi / 3)},
      {"wide cap", [](const MeshOptions& o) { return make_cap(1.0, 2 * pi / 3, o); }, 3 * pi, 1,
       2 * pi * std::sin(pi / 3)},
      {"open cap", [](const MeshOptions& o) { return make_cap(1.0, pi / 2, o, 0.45); }, 2 * pi * std::cos(0.45), 0,
       2 * pi * (1 + std::sin(0.45))},
      {"tube", [](const MeshOptions& o) { return make_tube(0.5, 1.5, o); }, 1.5 * pi, 0, 2 * pi},
  };
}

constexpr std::array patterns = {Pattern::structured, Pattern::equilateral, Pattern::irregular};

std::string context(const Shape& shape, Pattern pattern) {
  return std::string(shape.name) + ", pattern " + std::to_string(static_cast<int>(pattern));
}

TEST(Shapes, AreSoundMeshesOfTheRightTopology) {
  for (const Shape& shape : all_shapes())
    for (const Pattern pattern : patterns) {
      SCOPED_TRACE(context(shape, pattern));
      const TriangleMesh mesh = shape.make({pattern, 0.06, 3, {}});
      const MeshFigures f = measure(mesh);
      EXPECT_EQ(f.euler_characteristic(), shape.euler);
      EXPECT_EQ(f.bad_edges, 0U);
      EXPECT_NEAR(static_cast<double>(f.boundary_edges) * 0.06, shape.rim_length, 0.16 * shape.rim_length + 1e-12);
      EXPECT_NEAR(f.area, shape.area, 2e-3 * shape.area);
      std::vector<char> used(mesh.positions.size(), 0);
      for (const TriangleIndices& t : mesh.triangles)
        for (const std::uint32_t v : t)
          used[v] = 1;
      EXPECT_THAT(used, testing::Each(1));
    }
}

TEST(Shapes, MeanEdgeIsTheTarget) {
  for (const Shape& shape : all_shapes())
    for (const Pattern pattern : patterns)
      for (const double length : {0.2, 0.1, 0.04}) {
        SCOPED_TRACE(context(shape, pattern) + ", edge " + std::to_string(length));
        const MeshFigures f = measure(shape.make({pattern, length, 1, {}}));
        EXPECT_NEAR(f.edge_mean, length, (length > 0.15 ? 0.15 : 0.1) * length);
      }
}

TEST(Shapes, AnglesAreGood) {
  for (const Shape& shape : all_shapes())
    for (const double length : {0.25, 0.12, 0.04}) {
      SCOPED_TRACE(std::string(shape.name) + ", edge " + std::to_string(length));
      EXPECT_GT(measure(shape.make({Pattern::equilateral, length, 1, {}})).angle_min, 25 * degree);
      for (std::uint64_t seed = 1; seed <= (length < 0.05 ? 1U : 8U); ++seed)
        EXPECT_GT(measure(shape.make({Pattern::irregular, length, seed, {}})).angle_min, 25 * degree) << seed;
    }
}

// Shapes of one or a few edges, long, thin, tiny and huge ones.
TEST(Shapes, IrregularPatternCopesWithExtremes) {
  const auto expect_good = [](const TriangleMesh& mesh, long euler) {
    const MeshFigures f = measure(mesh);
    EXPECT_EQ(f.euler_characteristic(), euler);
    EXPECT_EQ(f.bad_edges, 0U);
    EXPECT_GT(f.angle_min, 25 * degree);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const auto options = [&](double length) { return MeshOptions{Pattern::irregular, length, seed, {}}; };
    expect_good(make_rectangle(1, 1, options(1)), 1);
    expect_good(make_rectangle(1, 1, options(0.4)), 1);
    expect_good(make_rectangle(10, 0.1, options(0.06)), 1);
    expect_good(make_disk(1, options(1)), 1);
    expect_good(make_disk(1e-3, options(2e-4)), 1);
    expect_good(make_disk(1e5, options(2e4)), 1);
    expect_good(make_annulus(0.9, 1, options(0.06)), 0);
    expect_good(make_annulus(0.1, 1, options(0.1)), 0);
    expect_good(make_sphere(1, options(1.05)), 2);
    expect_good(make_cap(1, 3.0, options(0.14)), 1);
    expect_good(make_cap(1, 0.1, options(0.1)), 1);
    expect_good(make_tube(1, 1, options(1)), 0);
    expect_good(make_tube(0.1, 5, options(0.1)), 0);
  }
}

TEST(Shapes, AreaConvergesAtSecondOrder) {
  for (const Shape& shape : all_shapes())
    for (const Pattern pattern : patterns) {
      SCOPED_TRACE(context(shape, pattern));
      const auto error = [&](double length) {
        return std::abs(measure(shape.make({pattern, length, 1, {}})).area - shape.area);
      };
      const double coarse = error(0.16), fine = error(0.04);
      EXPECT_LT(fine, 1e-12 + coarse / 8.0); // 16 in the limit
    }
}

TEST(Shapes, ClosedSphereFacesOutward) {
  for (const Pattern pattern : patterns) {
    const TriangleMesh mesh = make_sphere(2.0, {pattern, 0.15, 1, {}});
    const MeshFigures f = measure(mesh);
    EXPECT_EQ(f.boundary_edges, 0U);
    EXPECT_NEAR(f.volume, 4.0 / 3.0 * pi * 8.0, 0.01 * 33.5);
    for (const Eigen::Vector3d& x : mesh.positions)
      EXPECT_NEAR(x.norm(), 2.0, 1e-15 * 4);
    for (const TriangleIndices& t : mesh.triangles)
      EXPECT_GT(mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])), 0.0);
  }
}

TEST(Shapes, FlatShapesFaceUpAndCurvedOnesOutward) {
  for (const Shape& shape : all_shapes())
    for (const Pattern pattern : patterns) {
      SCOPED_TRACE(context(shape, pattern));
      const TriangleMesh mesh = shape.make({pattern, 0.1, 5, {}});
      const bool flat = shape.name == std::string("rectangle") || shape.name == std::string("disk") ||
                        shape.name == std::string("annulus");
      for (const TriangleIndices& t : mesh.triangles) {
        const Eigen::Vector3d &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        Eigen::Vector3d out = flat ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(a + b + c);
        if (shape.name == std::string("tube"))
          out.z() = 0.0;
        ASSERT_GT((b - a).cross(c - a).dot(out), 0.0);
      }
    }
}

TEST(Shapes, RimsLieOnTheShape) {
  for (const Pattern pattern : patterns) {
    for (const TriangleMesh& mesh :
         {make_annulus(0.5, 1.0, {pattern, 0.1, 1, {}}), make_cap(1.0, pi / 2, {pattern, 0.1, 1, {}})})
      for (const MeshEdge& edge : mesh_edges(mesh.triangles))
        if (edge.up + edge.down == 1)
          for (const std::uint32_t v : {edge.a, edge.b}) {
            const double r = mesh.positions[v].norm();
            EXPECT_TRUE(std::abs(r - 1.0) < 1e-15 || std::abs(r - 0.5) < 1e-15) << r;
          }
    const TriangleMesh tube = make_tube(0.5, 1.0, {pattern, 0.1, 1, {}});
    for (const Eigen::Vector3d& x : tube.positions)
      EXPECT_NEAR(std::hypot(x.x(), x.y()), 0.5, 1e-15);
  }
}

TEST(Shapes, SeedDecidesToTheLastBit) {
  for (const Shape& shape : all_shapes()) {
    SCOPED_TRACE(shape.name);
    const TriangleMesh a = shape.make({Pattern::irregular, 0.12, 7, {}});
    const TriangleMesh b = shape.make({Pattern::irregular, 0.12, 7, {}});
    const TriangleMesh c = shape.make({Pattern::irregular, 0.12, 8, {}});
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_NE(a.positions, c.positions);
  }
}

// The angles of edges have no preferred direction: the hexagonal order parameter |mean exp(6 i angle)| is small.
TEST(Shapes, IrregularPatternHasNoLattice) {
  const auto order = [](const TriangleMesh& mesh) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const std::vector<MeshEdge> edges = mesh_edges(mesh.triangles);
    for (const MeshEdge& edge : edges) {
      const Eigen::Vector3d d = mesh.positions[edge.b] - mesh.positions[edge.a];
      const double angle = 6.0 * std::atan2(d.y(), d.x());
      sum += Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    return sum.norm() / static_cast<double>(edges.size());
  };
  EXPECT_LT(order(make_disk(1.0, {Pattern::irregular, 0.03, 1, {}})), 0.05);
  EXPECT_GT(order(make_disk(1.0, {Pattern::equilateral, 0.03, 1, {}})), 0.6);
}

TEST(Shapes, ExplicitSegments) {
  const auto count = [](const TriangleMesh& mesh) { return std::pair(mesh.positions.size(), mesh.triangles.size()); };
  const auto options = [](std::uint32_t a, std::uint32_t b) {
    return MeshOptions{Pattern::structured, 0.0, 1, std::array{a, b}};
  };
  EXPECT_EQ(count(make_rectangle(1, 1, options(30, 10))), (std::pair<std::size_t, std::size_t>(31 * 11, 600)));
  EXPECT_EQ(count(make_annulus(0.1, 0.25, options(80, 25))), (std::pair<std::size_t, std::size_t>(80 * 26, 4000)));
  EXPECT_EQ(count(make_tube(1, 1, options(12, 4))), (std::pair<std::size_t, std::size_t>(60, 96)));
  EXPECT_EQ(count(make_cap(1, pi / 2, options(50, 32), 0.3)), (std::pair<std::size_t, std::size_t>(50 * 33, 3200)));
  EXPECT_EQ(count(make_disk(1, options(8, 3))), (std::pair<std::size_t, std::size_t>(25, 8 + 32)));
  EXPECT_EQ(count(make_sphere(1, options(5, 1))), (std::pair<std::size_t, std::size_t>(6 * 25 + 2, 300)));
  for (const TriangleMesh& mesh : {make_disk(1, options(7, 3)), make_disk(1, options(7, 1)),
                                   make_cap(1, 1, options(7, 1)), make_cap(1, 1, options(5, 4))}) {
    EXPECT_EQ(measure(mesh).euler_characteristic(), 1);
    EXPECT_EQ(measure(mesh).bad_edges, 0U);
  }
}

TEST(Shapes, GeodesicSphereHasAnyFrequency) {
  for (const double frequency : {1.0, 2.0, 3.0, 7.0}) {
    const double length = std::sqrt(4 * pi / (5.0 * std::numbers::sqrt3)) / frequency;
    const std::size_t n = static_cast<std::size_t>(frequency);
    if (n == 1) // the icosahedron itself: its edge is 1.05
      EXPECT_EQ(make_sphere(1.0, {Pattern::equilateral, 1.0514, 1, {}}).triangles.size(), 20U);
    else
      EXPECT_EQ(make_sphere(1.0, {Pattern::equilateral, length, 1, {}}).triangles.size(), 20 * n * n);
  }
}

template <class F> std::string message_of(F&& make) {
  try {
    make();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "no error";
}

TEST(Shapes, ErrorsNameWhatIsWrong) {
  using testing::HasSubstr;
  const MeshOptions fine{Pattern::irregular, 0.1, 1, {}};
  const double nan = std::nan("");
  EXPECT_THAT(message_of([&] { (void)make_disk(-1.0, fine); }), HasSubstr("radius"));
  EXPECT_THAT(message_of([&] { (void)make_disk(nan, fine); }), HasSubstr("radius"));
  EXPECT_THAT(message_of([&] { (void)make_disk(1.0, {Pattern::irregular, 0.0, 1, {}}); }), HasSubstr("edge_length"));
  EXPECT_THAT(message_of([&] { (void)make_disk(0.05, fine); }), HasSubstr("too large"));
  EXPECT_THAT(message_of([&] { (void)make_rectangle(1.0, 0.05, fine); }), HasSubstr("too large"));
  EXPECT_THAT(message_of([&] {
                (void)make_rectangle(1e3, 1e3, {Pattern::structured, 0.01, 1, {}});
              }),
              HasSubstr("more than 50000000"));
  EXPECT_THAT(message_of([&] { (void)make_sphere(1e300, fine); }), HasSubstr("more than 50000000"));
  EXPECT_THAT(message_of([&] { (void)make_annulus(1.0, 0.5, fine); }), HasSubstr("smaller"));
  EXPECT_THAT(message_of([&] { (void)make_cap(1.0, 4.0, fine); }), HasSubstr("angle"));
  EXPECT_THAT(message_of([&] { (void)make_cap(1.0, 0.5, fine, 0.6); }), HasSubstr("opening"));
  EXPECT_THAT(message_of([&] { (void)make_tube(1.0, 0.0, fine); }), HasSubstr("height"));
  EXPECT_THAT(message_of([&] {
                (void)make_tube(1, 1, {Pattern::irregular, 0.1, 1, {{8, 8}}});
              }),
              HasSubstr("structured"));
  EXPECT_THAT(message_of([&] { (void)make_tube(1, 1, {Pattern::structured, 0.1, 1, {{2, 1}}}); }), HasSubstr("few"));
  EXPECT_THAT(message_of([&] {
                (void)make_tube(1, 1, {Pattern::structured, 0.1, 1, {{100000, 100000}}});
              }),
              HasSubstr("more than"));
}

} // namespace
} // namespace sheet
