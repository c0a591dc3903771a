// SPDX-License-Identifier: GPL-3.0-or-later
// What whole calls of remesh() keep: shape, thickness, quality, safety; small versions of bench_remesh_cycles and
// bench_remesh_flows, with the same bars.
#include "libsheet/remesh/remesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/measure/intersections.h"
#include "libsheet/shape/shapes.h"
#include "tests/support/remesh/cycles.h"
#include "tests/support/remesh/flows.h"
#include "tests/support/remesh/options.h"

namespace sheet::remesh {
namespace {

using test::edges;
using test::options;

std::uint64_t intersecting_pairs(const formats::Frame& frame) {
  const std::vector<bool> usable(frame.triangles, true);
  return find_intersections(positions(frame), triangles(frame), usable, 1).count;
}

TEST(Cycles, ASphereKeepsVolumeAndArea) {
  formats::Frame frame = test::frame_of(make_sphere(1, edges(0.25)), 0.01);
  for (Vector3& u : velocities(frame))
    u = {1, 2, 3};
  const test::Account start = test::account_of(frame);
  for (int i = 0; i < 20; ++i)
    EXPECT_GT(test::cycle(frame, options(0.25)), 100U);
  const test::Account end = test::account_of(frame);
  EXPECT_NEAR(end.volume, start.volume, 1e-14 * start.volume);
  EXPECT_NEAR(end.enclosed, start.enclosed, 1e-3 * start.enclosed);
  EXPECT_NEAR(end.area, start.area, 3e-3 * start.area);
  EXPECT_LT((end.momentum - start.momentum).norm(), 1e-13 * start.speed_sum);
  EXPECT_NEAR(end.kinetic_energy, start.kinetic_energy, 1e-12 * start.kinetic_energy); // a uniform velocity stays one
}

// The mean of (h - low) (high - h) across a ramp is a sixth of the step's square; the square is 1 wide.
double step_width(const formats::Frame& frame) {
  double sum = 0;
  const auto x = positions(frame);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const double area = 0.5 * (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm(), h = volumes(frame)[t] / area;
    sum += 6 * area * (h - 0.01) * (0.02 - h) / (0.01 * 0.01);
  }
  return sum;
}

TEST(Cycles, AStepOfThicknessKeepsItsRange) {
  formats::Frame frame = test::frame_of(make_rectangle(1, 1, edges(0.1)), 1);
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(std::as_const(frame))[t];
    const auto x = positions(std::as_const(frame));
    volumes(frame)[t] *= (x[c[0]] + x[c[1]] + x[c[2]])[0] < 0 ? 0.01 : 0.02;
  }
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(test::cycle(frame, options(0.1)));
    const test::Account now = test::account_of(frame);
    EXPECT_GT(now.thickness_min, 0.01 * (1 - 1e-9));
    EXPECT_LT(now.thickness_max, 0.02 * (1 + 1e-9));
    EXPECT_NEAR(now.area, 1, 1e-12);
  }
  EXPECT_LT(step_width(frame), 3 * 0.1); // of edges; 5.6 if each new triangle got the mean of the old ones
}

TEST(Cycles, AWavySheetOvershootsByLessThanOnePercent) {
  formats::Frame frame = test::frame_of(test::wrinkled(0.02, 0.01), 0.01);
  for (int i = 0; i < 2; ++i)
    static_cast<void>(test::cycle(frame, options(0.02)));
  const test::Account now = test::account_of(frame);
  EXPECT_GT(now.thickness_min, 0.01 * 0.99);
  EXPECT_LT(now.thickness_max, 0.01 * 1.01);
}

TEST(Cycles, NearLayersDoNotComeToIntersect) {
  for (const TriangleMesh& mesh : {test::two_caps(0.2, 0.01), test::z_fold(0.1, 0.01)}) {
    formats::Frame frame = test::frame_of(mesh, 0.001);
    ASSERT_EQ(intersecting_pairs(frame), 0U);
    const double edge_length = mesh.positions[0][2] > 0.01 ? 0.2 : 0.1;
    for (int i = 0; i < 5; ++i) {
      static_cast<void>(test::cycle(frame, options(edge_length)));
      ASSERT_EQ(intersecting_pairs(frame), 0U);
    }
  }
}

TEST(Flows, AnglesStayGood) {
  for (const test::Flow& flow : {test::vortex(0.01), test::shear(0.04), test::enright(0.02)}) {
    const test::FlowResult r = test::run_flow(flow, 0.5, options(flow.edge_length));
    const bool folds = flow.name.find("sphere") != std::string::npos;
    EXPECT_GT(r.worst.smallest, folds ? 15 : 20) << flow.name;
    EXPECT_GT(r.worst.first_percentile, 27) << flow.name;
    EXPECT_LT(r.worst.largest, 140) << flow.name;
    EXPECT_LT(r.volume_error, 1e-13) << flow.name;
  }
}

TEST(Remesh, LeavesAGoodMeshAsItIsBitForBit) {
  formats::Frame frame = test::frame_of(make_disk(1, edges(0.1)), 0.01);
  const formats::Frame before = frame;
  EXPECT_EQ(remesh(frame, nullptr, options(0.1)).edits(), 0U);
  EXPECT_TRUE(frame == before);
}

TEST(Remesh, RepeatsBitForBit) {
  const formats::Frame start = test::frame_of(test::wrinkled(0.05, 0.02), 0.01);
  formats::Frame one = start, two = start;
  static_cast<void>(remesh(one, nullptr, options(0.03)));
  static_cast<void>(remesh(two, nullptr, options(0.03)));
  EXPECT_TRUE(one == two);
}

TEST(Remesh, LargeMeshesAreNumberedAlongACurve) {
  formats::Frame frame = test::frame_of(make_rectangle(1, 1, edges(0.005)), 0.01);
  for (Vector3& x : positions(frame))
    x[0] *= 1.1;
  const auto apart = [&] { // on average over triangles, of all numbers
    double sum = 0;
    for (const Corners& c : triangles(std::as_const(frame)))
      sum += std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]});
    return sum / static_cast<double>(frame.triangles) / static_cast<double>(frame.vertices);
  };
  EXPECT_GT(apart(), 0.2); // as sheet-init makes it
  const formats::Frame start = frame;
  EXPECT_GT(remesh(frame, nullptr, options(0.005)).edits(), 0U);
  EXPECT_LT(apart(), 0.02);
  formats::Frame again = start;
  static_cast<void>(remesh(again, nullptr, options(0.005)));
  EXPECT_TRUE(again == frame);
}

TEST(Remesh, MicrometresAndKilometresAreTheSame) {
  const auto remeshed = [](double scale) {
    TriangleMesh mesh = test::wrinkled(0.05, 0.02);
    for (Vector3& x : mesh.positions)
      x *= scale;
    formats::Frame frame = test::frame_of(mesh, 0.01 * scale);
    static_cast<void>(remesh(frame, nullptr, options(0.0625 * scale)));
    return frame;
  };
  // powers of two scale without rounding
  const formats::Frame metres = remeshed(1), micrometres = remeshed(std::ldexp(1, -20)), kilometres = remeshed(1024);
  for (const formats::Frame* other : {&micrometres, &kilometres}) {
    ASSERT_EQ(other->vertices, metres.vertices);
    EXPECT_TRUE(*other->find("triangle") == *metres.find("triangle"));
    const double scale = other == &kilometres ? 1024 : std::ldexp(1, -20);
    for (std::size_t v = 0; v < metres.vertices; ++v)
      ASSERT_LT((positions(*other)[v] / scale - positions(metres)[v]).norm(), 1e-13);
  }
}

TEST(Remesh, RefinesAndCoarsensToTheLengthAskedFor) {
  for (const double wanted : {0.02, 0.3}) {
    formats::Frame frame = test::frame_of(make_disk(1, edges(0.1)), 0.01);
    static_cast<void>(remesh(frame, nullptr, options(wanted)));
    double sum = 0, count = 0;
    const auto x = positions(std::as_const(frame));
    for (const Corners& t : triangles(std::as_const(frame)))
      for (std::size_t i = 0; i < 3; ++i) {
        sum += (x[t[i]] - x[t[(i + 1) % 3]]).norm();
        ++count;
      }
    EXPECT_NEAR(sum / count, wanted, 0.25 * wanted) << wanted;
    EXPECT_GT(test::angles_of(frame, wanted).smallest, 20) << wanted;
  }
}

TEST(Adaptive, FollowsCurvatureWithinBounds) {
  // a plane that runs into a cylinder of radius 0.4
  TriangleMesh mesh = make_rectangle(1.6, 0.5, edges(0.03));
  for (Vector3& x : mesh.positions) {
    const double s = x[0];
    if (s > 0) {
      const double a = std::min(s / 0.4, 2.0);
      const double rest = std::max(0.0, s - 0.8);
      x = {0.4 * std::sin(a) + rest * std::cos(a), x[1], 0.4 * (1 - std::cos(a)) + rest * std::sin(a)};
    }
  }
  formats::Frame frame = test::frame_of(mesh, 0.001);
  Options o = options(0.15);
  o.size.chord_error = 0.001; // sqrt(8 * 0.001 * 0.4) = 0.057 on the cylinder
  o.size.min_edge = 0.02;
  o.size.max_edge = 0.2;
  static_cast<void>(remesh(frame, nullptr, o));
  double flat = 0, flat_count = 0, round = 0, round_count = 0;
  const auto x = positions(std::as_const(frame));
  for (const Corners& t : triangles(std::as_const(frame)))
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 middle = 0.5 * (x[t[i]] + x[t[(i + 1) % 3]]);
      const double length = (x[t[i]] - x[t[(i + 1) % 3]]).norm();
      if (middle[0] < -0.5) {
        flat += length;
        ++flat_count;
      } else if (middle[2] > 0.05 && middle[2] < 0.4) {
        round += length;
        ++round_count;
      }
    }
  EXPECT_NEAR(round / round_count, 0.057, 0.02);
  EXPECT_GT(flat / flat_count, 0.12);
  EXPECT_LT(flat / flat_count, 0.2);
}

} // namespace
} // namespace sheet::remesh
