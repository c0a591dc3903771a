// SPDX-License-Identifier: GPL-3.0-or-later
// Drops that come off a sheet: of threads, of crumbs, of small pieces.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libsheet/flow/outflow.h"
#include "libsheet/flow/shed.h"
#include "libsheet/flow/tear.h"
#include "libsheet/flow/threads.h"
#include "libsheet/sheet/append.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Array;
using formats::Frame;
using test::volume_of;

Scene shed_scene(const std::string& more = "[tear]\ndrops = true\n") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nedge_length = 1\nthickness = 0.25\n"
                     "[material]\nviscosity = 0.001\ndensity = 1000\nsurface_tension = 0.07\n" +
                         more,
                     "scene");
}

struct Sums {
  double volume = 0;
  Vector3 momentum = Vector3::Zero(), moment = Vector3::Zero(); // by volume
};

// Of triangles and drops.
Sums sums_of(const Frame& frame) {
  Sums sums{volume_of(frame) + volume_of_drops(frame), Vector3::Zero(), Vector3::Zero()};
  for (std::size_t t = 0; t < frame.triangles; ++t)
    for (const std::uint32_t v : triangles(frame)[t]) {
      sums.momentum += volumes(frame)[t] / 3 * velocities(frame)[v];
      sums.moment += volumes(frame)[t] / 3 * positions(frame)[v];
    }
  for (const Drop& drop : read_drops(frame)) {
    sums.momentum += drop.volume * drop.velocity;
    sums.moment += drop.volume * drop.position;
  }
  return sums;
}

void expect_same(const Sums& a, const Sums& b) {
  EXPECT_NEAR(a.volume / b.volume, 1, 1e-14);
  EXPECT_NEAR((a.momentum - b.momentum).norm(), 0, 1e-14 * b.momentum.norm());
  EXPECT_NEAR((a.moment - b.moment).norm(), 0, 1e-14 * b.moment.norm());
}

// A sheet of 6 x 6 squares of 1 m, and beside it another one, of `columns` x `rows` squares, turning as it flies.
Frame with_piece(std::uint32_t columns, std::uint32_t rows, double deep) {
  Frame frame = test::grid(6, 6, 1, 0.2), piece = test::grid(columns, rows, 1, deep);
  for (Vector3& x : positions(piece))
    x += Vector3(10, 0, 1);
  (void)velocities(frame);
  for (std::size_t v = 0; v < piece.vertices; ++v)
    velocities(piece)[v] = Vector3(3, -2, 1) + Vector3(0, 0, 2).cross(positions(piece)[v]);
  append(piece, frame);
  return frame;
}

TEST(Shed, ARoundPieceBecomesADrop) {
  Frame frame = with_piece(2, 2, 0.5);
  const Sums before = sums_of(frame);
  const Shed shed = shed_round_pieces(frame, shed_scene());
  ASSERT_EQ(shed.drops.size(), 1U);
  EXPECT_EQ(shed.sum.triangles, 8U);
  EXPECT_EQ(frame.triangles, 72U);
  EXPECT_EQ(test::value_error(frame), "");
  EXPECT_NEAR(shed.drops[0].position.x(), 11, 2e-2); // test::grid is a little uneven
  expect_same(sums_of(frame), before);
}

TEST(Shed, WhatIsNoDropStays) {
  const Scene drops = shed_scene(), held = shed_scene("[[hold]]\nregion = \"rim\"\n[tear]\ndrops = true\n"),
              without = shed_scene("[tear]\nsnap = 0.001\n");
  Frame thin = with_piece(2, 2, 0.002), large = with_piece(8, 8, 8), long_one = with_piece(9, 1, 0.5);
  for (Frame& frame : std::array{thin, large, long_one}) {
    const Frame before = frame;
    EXPECT_EQ(shed_round_pieces(frame, drops).drops.size(), 0U);
    EXPECT_EQ(frame, before);
  }
  Frame alone = test::grid(2, 2, 1, 0.5), without_key = with_piece(2, 2, 0.5), touching = with_piece(2, 2, 0.5),
        fixed = touching;
  EXPECT_EQ(shed_round_pieces(alone, drops).drops.size(), 0U);
  EXPECT_EQ(shed_round_pieces(without_key, without).drops.size(), 0U);
  std::vector<std::int32_t> touch(touching.vertices, no_solid);
  touch.back() = 0;
  put_touched_solids(touching, touch, 1);
  EXPECT_EQ(shed_round_pieces(touching, drops).drops.size(), 0U);
  put_masks(fixed, "hold").back() = 1;
  EXPECT_EQ(shed_round_pieces(fixed, held).drops.size(), 0U);
}

// Strips of a row of squares of 0.1 m, 0.02 m thick: threads of the same section part into waves.
TEST(Shed, AThreadPartsIntoSeveralDrops) {
  constexpr std::uint32_t columns = 200;
  constexpr double cell = 0.1, deep = 0.02;
  Frame frame = test::grid(columns, 1, cell, deep);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = {positions(frame)[v].x(), 0, 1};
  const Sums before = sums_of(frame);
  const double radius = std::sqrt(cell * deep / std::numbers::pi), length = columns * cell;
  const auto count = [&](const Scene& of) {
    return what_becomes_of(frame, std::vector<bool>(frame.triangles, true), of).drops.size();
  };
  const double inviscid = length / (2 * std::numbers::sqrt2 * std::numbers::pi * radius);
  EXPECT_NEAR(static_cast<double>(count(shed_scene())), inviscid, 1);
  Scene viscous = shed_scene();
  viscous.material.viscosity = 2.5; // Oh = 2.5/sqrt(2 x 1000 x 0.07 x 0.0252) = 1.33
  const double ohnesorge = 2.5 / std::sqrt(2 * 1000 * 0.07 * radius);
  EXPECT_NEAR(static_cast<double>(count(viscous)), inviscid / std::sqrt(1 + 3 * ohnesorge), 1);
  Scene slack = shed_scene();
  slack.material.surface_tension = 0;
  EXPECT_EQ(count(slack), 1U);
  const Shed shed = what_becomes_of(frame, std::vector<bool>(frame.triangles, true), shed_scene());
  Frame drops = test::grid(1, 1, 1, 1e-300); // as good as nothing
  (void)velocities(drops);
  write_drops(drops, shed.drops);
  expect_same(sums_of(drops), before);
  EXPECT_GT(std::abs(shed.drops.front().velocity.x() - shed.drops.back().velocity.x()), 0.8 * length); // in a row
}

// As many as of the Newtonian liquid that waves feel in it: at the rate at which it is drawn, and at its temperature.
TEST(Shed, AThreadPartsByItsViscosityAtItsRateAndTemperature) {
  constexpr double cell = 0.1, deep = 0.02, drawn = 4; // [1/s]
  Frame frame = test::grid(200, 1, cell, deep);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    velocities(frame)[v] = {drawn * positions(frame)[v].x(), 0, 0};
  const auto count = [&](const Scene& of) {
    return what_becomes_of(frame, std::vector<bool>(frame.triangles, true), of).drops.size();
  };
  const auto newtonian = [&](double viscosity) {
    Scene scene = shed_scene();
    scene.material.viscosity = viscosity;
    return count(scene);
  };
  Scene thins = shed_scene(), yields = shed_scene(), warm = shed_scene();
  thins.material.viscosity = yields.material.viscosity = 20;
  thins.material.law = {.kind = FlowLawKind::power, .flow_index = 0.5};
  EXPECT_EQ(count(thins), newtonian(20 * 0.5 * std::pow(2 * drawn, -0.5))); // stretched along x only, it has 2 |du/dx|
  EXPECT_GT(count(thins), newtonian(20));
  yields.material.law = {.kind = FlowLawKind::bingham, .yield_stress = 1};
  EXPECT_EQ(count(yields), newtonian(20));
  warm.material.viscosity = 2.5;
  warm.material.temperature_law = {
      .kind = TemperatureLawKind::exponential, .reference_temperature = 300, .temperature_coefficient = 0.1};
  Array array = formats::make_standard_array("temperature", frame.triangles);
  for (double& temperature : array.values<double>())
    temperature = 320;
  frame.put(std::move(array));
  EXPECT_EQ(count(warm), newtonian(2.5 * std::exp(-2)));
  EXPECT_GT(count(warm), newtonian(2.5));
}

// What a threads' cut has given to an account becomes drops, and no account is opened.
TEST(Shed, WithoutDropsThereAreAccounts) {
  Frame frame = with_piece(2, 2, 0.5);
  std::vector<bool> leaves(frame.triangles, false);
  std::fill(leaves.end() - 8, leaves.end(), true);
  Frame lost = frame;
  (void)shed_off(lost, leaves, shed_scene("[tear]\nsnap = 0.001\n"));
  EXPECT_EQ(lost.find("drop_volume"), nullptr);
  EXPECT_NEAR(lost.find("tear.volume")->values<double>()[0], 2, 0.05);
  (void)shed_off(frame, leaves, shed_scene());
  EXPECT_EQ(frame.find("tear.volume"), nullptr);
  EXPECT_EQ(read_drops(frame).size(), 1U);
}

TEST(Shed, DropsLeaveAtAnOutflow) {
  Frame frame = test::grid(4, 2, 1, 0.25);
  (void)velocities(frame);
  write_drops(frame, std::vector<Drop>{{.position = {0, 0, 9}, .velocity = {0, 0, 2}, .volume = 0.5},
                                       {.position = {0, 0, 7}, .velocity = {0, 0, 2}, .volume = 0.25}});
  const Dropped out =
      let_out(frame, shed_scene("[[outflow]]\npoint = [0, 0, 8]\nnormal = [0, 0, 1]\n[tear]\ndrops = true\n"));
  EXPECT_EQ(out.triangles, 0U);
  ASSERT_EQ(read_drops(frame).size(), 1U);
  EXPECT_EQ(read_drops(frame)[0].volume, 0.25);
  EXPECT_EQ(frame.find("outflow.volume")->values<double>()[0], 0.5);
  EXPECT_EQ(frame.find("outflow.momentum")->values<double>()[2], 1000);
  EXPECT_EQ(frame.find("outflow.energy")->values<double>()[0], 1000);
}

} // namespace
} // namespace sheet::flow
