// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/measure/measure.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {
namespace {

using Eigen::Vector3d;

// The unit square as two triangles of thickness 0.01 and 0.02.
formats::Frame square() {
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Corners> t = {{0, 1, 2}, {0, 2, 3}};
  return make_frame(x, t, std::vector<double>{0.005, 0.01});
}

TEST(Measure, Square) {
  formats::Frame frame = square();
  for (Vector3d& v : velocities(frame))
    v = {0, 0, 2};
  const Measurements m = measure(frame, 1000);
  EXPECT_DOUBLE_EQ(m.area, 1);
  EXPECT_DOUBLE_EQ(m.volume, 0.015);
  EXPECT_DOUBLE_EQ(m.range_of("thickness").least, 0.01);
  EXPECT_DOUBLE_EQ(m.range_of("thickness").mean, 0.015);
  EXPECT_DOUBLE_EQ(m.range_of("thickness").greatest, 0.02);
  EXPECT_DOUBLE_EQ(m.kinetic_energy, 15 * 4 / 2.0);
  EXPECT_NEAR((m.momentum - Vector3d(0, 0, 30)).norm(), 0, 1e-12);
  // m x × v with the centers of mass (2/3, 1/3) and (1/3, 2/3) of 5 and 10 kg
  const double cx = 5 * 2.0 / 3 + 10 / 3.0, cy = 5 / 3.0 + 10 * 2.0 / 3;
  EXPECT_NEAR((m.angular_momentum - Vector3d(2 * cy, -2 * cx, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(m.low, Vector3d(0, 0, 0));
  EXPECT_EQ(m.high, Vector3d(1, 1, 0));
  EXPECT_DOUBLE_EQ(m.edge.least, 1);
  EXPECT_DOUBLE_EQ(m.edge.greatest, std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(m.edge.mean, (4 + std::numbers::sqrt2) / 5);
  EXPECT_DOUBLE_EQ(m.angle_min, std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(m.angle_max, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(m.aspect_max, std::sqrt(3));
  EXPECT_EQ(m.topology.boundary_loops, 1);
  EXPECT_EQ(m.topology.euler_characteristic, 1);
}

TEST(Measure, PercentilesOfTheThicknessAreByArea) {
  // strips of a square: 3 % of the area are 3 thick, 45 % 1, 52 % 2; one triangle is thickest, one thinnest
  const std::array<double, 4> ends = {0, 0.03, 0.48, 1}, thickness = {3, 1, 2, 0};
  std::vector<Vector3d> x;
  std::vector<Corners> t;
  std::vector<double> volume;
  for (std::uint32_t i = 0; i < 4; ++i) {
    x.emplace_back(ends[i], 0, 0);
    x.emplace_back(ends[i], 1, 0);
    if (i == 3)
      break;
    t.push_back({2 * i, 2 * i + 2, 2 * i + 3});
    t.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    volume.insert(volume.end(), 2, (ends[i + 1] - ends[i]) / 2 * thickness[i]);
  }
  volume[0] *= 1.001;
  volume[2] *= 0.999;
  const Measurements m = measure(make_frame(x, t, volume), {});
  const std::array<double, 5> due = {0.999, 0.999, 2, 2, 3.003};
  for (std::size_t i = 0; i < due.size(); ++i)
    EXPECT_NEAR(m.thickness_percentiles[i], due[i], 1e-12) << percents[i];
  EXPECT_NEAR((m.thinnest_at - Vector3d(0.03 + 0.45 * 2 / 3, 1 / 3.0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((m.thickest_at - Vector3d(0.03 * 2 / 3, 1 / 3.0, 0)).norm(), 0, 1e-12);
}

TEST(Measure, OfDegenerateTrianglesHasThePercentilesOfTheOthers) {
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Measurements m =
      measure(make_frame(x, std::vector<Corners>{{0, 1, 2}, {0, 1, 1}}, std::vector<double>{0.5, 0}), {});
  EXPECT_EQ(m.thickness_percentiles[0], 1);
  EXPECT_EQ(m.thickness_percentiles[4], 1);
}

TEST(Measure, WithoutDensityAndAtRest) {
  EXPECT_TRUE(std::isnan(measure(square(), {}).kinetic_energy));
  EXPECT_EQ(measure(square(), 1000).kinetic_energy, 0);
}

// Two squares of 1 m, one thick and one thin, of two liquids: each has the faces of its own tension.
TEST(Measure, SurfaceEnergyOfTwoLiquidsIsTheSumOfEachOnes) {
  const auto scene = [](double one, double other) {
    const std::string sheet = "[[sheet]]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 1\nthickness = 0.1\n";
    const auto material = [](double tension) {
      return fmt::format("viscosity = 1\ndensity = 1\nsurface_tension = {}\n", tension);
    };
    return parse_scene("[material]\n" + material(one) + sheet + "name = \"a\"\n" + sheet +
                           "name = \"b\"\n[sheet.material]\n" + material(other) + "[model]\nfaces = true\n",
                       "scene");
  };
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}};
  formats::Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}},
                                    std::vector<double>{0.2, 0.2, 0.01, 0.01});
  formats::Array liquid = formats::make_standard_array("liquid", frame.triangles);
  std::ranges::copy(std::array<std::uint32_t, 4>{0, 0, 1, 1}, liquid.values<std::uint32_t>().begin());
  frame.put(std::move(liquid));
  const auto energy = [&](double one, double other) {
    Measurements m = measure(frame, 1);
    measure_energies(frame, scene(one, other), m);
    return m.surface_energy;
  };
  const double thick = 2 + 4 * std::numbers::pi / 4 * 0.4, thin = 2 + 4 * std::numbers::pi / 4 * 0.02;
  EXPECT_NEAR(energy(3, 7), 3 * thick + 7 * thin, 1e-12);
  EXPECT_NEAR(energy(7, 3), 7 * thick + 3 * thin, 1e-12);
}

TEST(Measure, LayersHaveNoTensionBetweenThem) {
  Scene scene;
  scene.material.surface_tension = 0.25;
  scene.solids.emplace_back().contact = SolidContact::flow;
  const std::vector<Vector3d> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  formats::Frame frame = make_frame(x, std::vector<Corners>{{0, 1, 2}, {3, 4, 5}}, std::vector<double>{0.5, 0.5});
  const auto energy = [&] {
    Measurements m = measure(frame, 1);
    measure_energies(frame, scene, m);
    return m.surface_energy;
  };
  EXPECT_DOUBLE_EQ(energy(), 0.25 * 4 * 0.5);
  std::vector<ContactSpring> springs(3);
  for (std::uint32_t v = 0; v < 3; ++v) {
    springs[v].vertices = {v, 3 + v, 3 + (v + 1) % 3, 3 + (v + 2) % 3};
    springs[v].weights = {1, -1, 0, 0};
  }
  write_springs(frame, springs);
  EXPECT_DOUBLE_EQ(energy(), 0.25 * 2 * 0.5); // as one body's
}

TEST(Measure, EmptyFrame) {
  const Measurements m = measure(make_frame({}, {}, {}), 1000);
  EXPECT_EQ(m.area, 0);
  EXPECT_EQ(m.volume, 0);
  EXPECT_EQ(m.kinetic_energy, 0);
  EXPECT_TRUE(std::isnan(m.range_of("thickness").mean));
  EXPECT_TRUE(std::isnan(m.thickness_percentiles[2]));
  EXPECT_TRUE(std::isnan(m.thinnest_at[0]));
  EXPECT_TRUE(std::isnan(m.low[0]));
  EXPECT_TRUE(std::isnan(m.edge.mean));
  EXPECT_FALSE(m.topology.closed);
}

Topology topology(const std::vector<Corners>& t, std::uint64_t vertices) {
  return find_topology(t, vertices, sorted_sides(t, vertices));
}

TEST(Topology, Tetrahedron) {
  const Topology t = topology({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4);
  EXPECT_TRUE(t.closed);
  EXPECT_EQ(t.edges, 6);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.boundary_loops, 0);
  EXPECT_EQ(t.components, 1);
}

TEST(Topology, BowTieIsOnePieceWithTwoLoops) {
  const Topology t = topology({{0, 1, 2}, {0, 3, 4}}, 6);
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.boundary_loops, 2);
  EXPECT_EQ(t.pinched_vertices, 1);
  EXPECT_EQ(t.unused_vertices, 1);
}

TEST(Topology, RingHasTwoLoops) {
  std::vector<Corners> t;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    t.push_back({i, j, i + 6});
    t.push_back({j, j + 6, i + 6});
  }
  const Topology ring = topology(t, 12);
  EXPECT_EQ(ring.boundary_loops, 2);
  EXPECT_EQ(ring.euler_characteristic, 0);
  EXPECT_EQ(ring.pinched_vertices, 0);
}

TEST(Topology, ThreeTrianglesAtAnEdge) {
  const Topology t = topology({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5);
  EXPECT_EQ(t.non_manifold_edges, 1);
  EXPECT_EQ(t.pinched_vertices, 0);
}

} // namespace
} // namespace sheet
