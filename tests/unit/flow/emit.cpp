// SPDX-License-Identifier: GPL-3.0-or-later
// Inflow without physics: sheets that move as one.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/flow/crossings.h"
#include "libsheet/flow/drowned_inlets.h"
#include "libsheet/flow/emit.h"
#include "libsheet/flow/entering.h"
#include "libsheet/flow/inlet.h"
#include "libsheet/flow/inlet_banks.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/remesh/remesh.h"
#include "libsheet/scene/inlet_depth.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/append.h"
#include "libsheet/sheet/transfer.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using test::error_of;
using test::volume_of;
using testing::HasSubstr;

constexpr double thickness = 0.25;

Scene scene_of(const std::string& velocity, const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nsegments = [4, 2]\npattern = \"structured\"\n"
                     "thickness = 0.25\n[material]\nviscosity = 1\ndensity = 1\n[inflow]\nregion = \"z_max\"\n"
                     "velocity = " +
                         velocity + "\n" + more,
                     "scene");
}

void mark_inlet(Frame& frame, const std::vector<std::uint32_t>& border) {
  const auto bits = put_masks(frame, "inlet");
  for (const std::uint32_t v : border)
    bits[v] = in_inlet | at_inlet_border;
  formats::Array& origins =
      frame.put(formats::make_array("inlet_origin", formats::Place::vertex, formats::Type::float64, 3, "m",
                                    formats::Transfer::interpolate, frame.vertices));
  std::ranges::copy(positions(frame), origins.values<Vector3>().begin());
}

// 4 x 2 squares of 1 m, liquid enters at the upper border, y = 2.
Frame curtain() {
  Frame frame = test::grid(4, 2, 1, thickness);
  mark_inlet(frame, {10, 11, 12, 13, 14});
  return frame;
}

// A tube along z around the z axis, liquid enters at its upper end.
Frame tube(std::uint32_t around) {
  std::vector<Vector3> x;
  std::vector<Corners> t;
  std::vector<std::uint32_t> border;
  for (std::uint32_t j = 0; j < 2; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      x.emplace_back(std::cos(angle), std::sin(angle), j);
    }
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    t.push_back({i, next, around + i});
    t.push_back({next, around + next, around + i});
    border.push_back(around + i);
  }
  Frame frame = make_frame(x, t, std::vector<double>(t.size(), 0.1));
  mark_inlet(frame, border);
  return frame;
}

// The whole sheet moves with what is in the inlet.
void move(Frame& frame, const Scene& scene, double dt) {
  const scene::InletVelocity velocity = scene::inlet_velocity(frame, scene, 0);
  for (Vector3& x : positions(frame))
    x += velocity.way(frame.time, frame.time + dt, x);
  frame.time += dt;
}

double account(const Frame& frame) { return number(frame, "emit.volume", 0); }

using test::value_error;

// Vertices that are in the inlet, by what they are.
std::size_t count(const Frame& frame, std::uint64_t bits) {
  return static_cast<std::size_t>(std::ranges::count(masks(frame, "inlet"), bits));
}

// A triangle lies across the gap that has opened behind the border, 0.9 m wide.
TEST(Emit, SaysWhichInletHasNoRoomAndWhatToDo) {
  for (const bool self : {false, true}) {
    const Scene scene = scene_of("[0, -1, 0]", self ? "[contact]\nself = true\n" : "");
    Frame frame = curtain();
    move(frame, scene, 0.9);
    const std::vector<Vector3> x{{2, 1.6, -1}, {2.5, 1.6, 1}, {1.5, 1.6, 1}};
    const std::vector<Corners> across{{0, 1, 2}};
    append(make_frame(x, across, std::vector<double>{0.1}), frame);
    if (self)
      EXPECT_THAT(error_of([&] { (void)emit(frame, scene); }),
                  AllOf(HasSubstr("the inlet has no room near"), HasSubstr("Give it room")));
    else
      EXPECT_GT(emit(frame, scene).volume, 0);
  }
}

TEST(Emit, VolumeIsThicknessTimesWidthTimesWay) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = curtain();
  const double start = volume_of(frame);
  double entered = 0;
  for (const double dt : {0.3, 0.3, 0.3, 0.01, 0.7, 0.2, 0.9, 0.45, 1e-9, 0.6}) {
    move(frame, scene, dt);
    entered += emit(frame, scene).volume;
    ASSERT_EQ(value_error(frame), "");
    if (frame.time > 0.5) {
      EXPECT_NEAR(volume_of(frame), start + thickness * 4 * frame.time, 1e-14 * start) << frame.time;
      EXPECT_EQ(count(frame, in_inlet | at_inlet_border), 5);
      EXPECT_EQ(count(frame, behind_inlet), 5);
      for (std::size_t v = 0; v < frame.vertices; ++v)
        if (masks(frame, "inlet")[v] == 3) {
          EXPECT_EQ(positions(frame)[v][1], 2);
        }
    } else {
      EXPECT_EQ(volume_of(frame), start); // half a row has not yet gone by
    }
  }
  EXPECT_NEAR(account(frame), thickness * 4 * frame.time, 1e-14);
  EXPECT_NEAR(entered, account(frame), 1e-14);
  for (std::size_t t = 0; t < frame.triangles; ++t)
    EXPECT_NEAR(volumes(frame)[t] / test::area(frame, t), thickness, 1e-14);
}

// What hangs from the inlet goes on as the sheet's wave: at each vertex as far off its plane as at the start there.
TEST(Emit, TheSheetsWavesGoOnInWhatEnters) {
  const Scene scene = parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nsegments = [4, 2]\n"
                                  "pattern = \"structured\"\nplane = \"xy\"\ncenter = [2, 1, 0]\nthickness = 0.25\n"
                                  "perturbation = {amplitude = 0.01, wavelength = 5, direction = \"y\"}\n"
                                  "[material]\nviscosity = 1\ndensity = 1\n"
                                  "[inflow]\nregion = \"y_max\"\nvelocity = [0, -1, 0]\nthickness = 0.25\n",
                                  "scene");
  Frame frame = build_frame(scene);
  for (int k = 0; k < 40; ++k) {
    move(frame, scene, 0.25);
    emit(frame, scene);
  }
  ASSERT_GT(frame.vertices, 50);
  double greatest = 0;
  for (std::size_t v = 0; v < frame.vertices; ++v) {
    const Vector3& x = positions(frame)[v];
    if (masks(frame, "inlet")[v] != 0)
      continue;
    EXPECT_NEAR(x.z(), 0.01 * std::sin(2 * std::numbers::pi * (x.y() + frame.time - 1) / 5), 1e-5)
        << x.y(); // normals lean
    greatest = std::max(greatest, std::abs(x.z()));
  }
  EXPECT_GT(greatest, 0.008);
}

TEST(Emit, TheSheetsNoiseGoesOnInWhatEnters) {
  const std::string noise = "[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nsegments = [4, 2]\n"
                            "pattern = \"structured\"\nplane = \"xy\"\ncenter = [2, 1, 0]\nthickness = 0.25\n"
                            "perturbation = {amplitude = 0.01, seed = 3}\n[material]\nviscosity = 1\ndensity = 1\n"
                            "[inflow]\nregion = \"y_max\"\nvelocity = [0, -1, 0]\nthickness = 0.25\n";
  const auto run = [](const Scene& scene) {
    Frame frame = build_frame(scene);
    for (int k = 0; k < 40; ++k) {
      move(frame, scene, 0.25);
      frame.step += 1;
      emit(frame, scene);
    }
    return frame;
  };
  const Frame frame = run(parse_scene(noise, "scene"));
  EXPECT_EQ(frame, run(parse_scene(noise, "scene")));
  std::set<double> ways;
  for (std::size_t v = 0; v < frame.vertices; ++v)
    if (masks(frame, "inlet")[v] == 0 && positions(frame)[v].y() > -8) {
      ways.insert(positions(frame)[v].z());
      EXPECT_LT(std::abs(positions(frame)[v].z()), 0.04); // its own, and part of that of the row below
    }
  EXPECT_GE(ways.size(), 40); // eight rows of five, each its own
  EXPECT_LT(*ways.begin(), -0.005);
  EXPECT_GT(*ways.rbegin(), 0.005);
}

// On a wall the first row moves as the border does, until another one is put behind it; elsewhere it is free.
TEST(Emit, OnAWallTheInletIsAChannelOneRowLong) {
  for (const char* contact : {"flow", "stick", ""}) {
    const std::string solid = "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -0.125]\ncontact = \"";
    const bool touches = *contact != '\0';
    const Scene scene = scene_of("[0, -1, 0]", touches ? solid + contact + "\"\n" : "");
    Frame frame = curtain();
    if (touches)
      put_touched_solids(frame, std::vector<std::int32_t>(frame.vertices, 0), 1);
    for (const int rows : {1, 2}) {
      move(frame, scene, rows == 1 ? 1.5 : 1);
      emit(frame, scene);
      const bool channel = std::string_view(contact) == "flow";
      EXPECT_EQ(count(frame, in_inlet | at_inlet_border), 5);
      EXPECT_EQ(count(frame, behind_inlet | in_inlet), channel ? 5 : 0);
      EXPECT_EQ(count(frame, behind_inlet), channel ? 0 : 5);
    }
  }
}

// What was there keeps its temperature, what enters has its own, and lies behind it.
TEST(Emit, WhatEntersIsAsWarmAsItEnters) {
  Scene scene = scene_of("[0, -1, 0]");
  scene.heat = scene::Heat{.specific_heat = 2, .temperature = 300};
  scene.inflows[0].temperature = scene::Timed<double>{{{0, 400}, {10, 400}}};
  for (const double dt : {0.25, 1.0, 4.75}) {
    Frame frame = curtain();
    put_temperatures(std::vector<double>(frame.triangles, 300), frame);
    const double before = volume_of(frame);
    double warmth = 0, coldest = 1e9, warmest = 0, entered = 0;
    for (int k = 0; k < 8; ++k) {
      move(frame, scene, dt);
      entered += emit(frame, scene).volume;
    }
    for (std::size_t t = 0; t < frame.triangles; ++t) {
      const double temperature = temperatures(frame)[t];
      warmth += volumes(std::as_const(frame))[t] * temperature;
      coldest = std::min(coldest, temperature);
      warmest = std::max(warmest, temperature);
    }
    EXPECT_NEAR(warmth, 300 * before + 400 * entered, 1e-12 * warmth);
    EXPECT_EQ(coldest, 300);
    EXPECT_LE(warmest, 400 + 1e-10);
    EXPECT_GT(warmest, 399.99);
    EXPECT_NEAR(frame.find("emit.heat")->values<double>()[0], 2 * 400 * entered, 1e-12 * warmth); // density 1
  }
}

TEST(Emit, RowsAreThoseOfAnyOtherStep) {
  const Scene scene = scene_of("[0, -1, 0]");
  const auto run = [&](double dt) {
    Frame frame = curtain();
    for (double t = 0; t < 8; t += dt) {
      move(frame, scene, dt);
      emit(frame, scene);
    }
    return frame;
  };
  const Frame fine = run(1.0 / 64); // binary fractions: no rounding
  EXPECT_EQ(fine, run(1.0 / 4));
  EXPECT_EQ(fine, run(2));
}

TEST(Emit, SeveralRowsMayBeDueAtOnce) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = curtain();
  move(frame, scene, 4.75);
  EXPECT_EQ(emit(frame, scene).rows, 5); // one row a metre, the strip has 0.75 rows
  EXPECT_NEAR(volume_of(frame), thickness * (8 + 4 * 4.75), 1e-14);
  std::vector<double> heights; // of the new rows, the border first
  for (std::size_t v = 15; v < frame.vertices; v += 5)
    heights.push_back(positions(frame)[v][1]);
  EXPECT_THAT(heights, testing::ElementsAre(2, -1.75, -0.75, 0.25, 1.25));
  EXPECT_EQ(value_error(frame), "");
}

TEST(Emit, TheSecondTimeNothingEnters) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = curtain();
  for (const double dt : {0.7, 0.2, 0.9}) {
    move(frame, scene, dt);
    emit(frame, scene);
    const Frame once = frame;
    EXPECT_EQ(emit(frame, scene).volume, 0);
    EXPECT_EQ(frame, once);
  }
}

TEST(Emit, NoVelocityNoInflow) {
  const Scene scene = scene_of("[[0, 0, 0, 0], [1, 0, 0, 0], [2, 0, -1, 0]]");
  Frame frame = curtain();
  const Frame before = frame;
  emit(frame, scene);
  EXPECT_EQ(frame, before);
  move(frame, scene, 1);
  emit(frame, scene);
  EXPECT_EQ(frame.vertices, before.vertices);
  move(frame, scene, 2); // 0.5 m while it quickens, then 1 m
  emit(frame, scene);
  EXPECT_NEAR(account(frame), thickness * 4 * 1.5, 1e-14);
}

TEST(Emit, SlantedAlongTheBorder) {
  const Scene scene = scene_of("[0.5, -1, 0]");
  Frame frame = curtain();
  for (int i = 0; i < 40; ++i) {
    move(frame, scene, 0.11);
    emit(frame, scene);
  }
  EXPECT_NEAR(volume_of(frame), thickness * (8 + 4 * frame.time), 1e-13);
  EXPECT_EQ(value_error(frame), "");
  (void)connect(frame.vertices, triangles(frame)); // a manifold, or an Error
}

TEST(Emit, SlantedOutOfTheSheetsPlane) {
  const Scene scene = scene_of("[0, -1, 1]");
  Frame frame = curtain();
  for (int i = 0; i < 40; ++i) {
    move(frame, scene, 0.11);
    emit(frame, scene);
  }
  EXPECT_NEAR(volume_of(frame), thickness * (8 + 4 * std::numbers::sqrt2 * frame.time), 1e-13);
}

TEST(Emit, ClosedTubeStraightAndSlanted) {
  for (const auto& [velocity, across] : {std::pair("[0, 0, -1]", 1.0), std::pair("[0.3, 0, -1]", 1.0)}) {
    const Scene scene = scene_of(velocity);
    for (const std::uint32_t around : {3U, 8U, 9U}) {
      Frame frame = tube(around);
      const double start = volume_of(frame);
      double width = 0; // of each edge, across the velocity, per speed
      const Vector3 v = scene.inflows[0].velocity.entries[0].value;
      for (std::uint32_t i = 0; i < around; ++i)
        width += (positions(frame)[(i + 1) % around] - positions(frame)[i]).cross(v).norm();
      for (int i = 0; i < 60; ++i) {
        move(frame, scene, 0.1);
        emit(frame, scene);
      }
      EXPECT_NEAR(volume_of(frame), start + thickness * width * frame.time, 1e-12) << around << velocity;
      EXPECT_EQ(value_error(frame), "");
      const Connectivity mesh = connect(frame.vertices, triangles(frame));
      std::size_t rim = 0;
      for (std::size_t e = 0; e < mesh.edges.size(); ++e)
        rim += mesh.on_rim(e) ? 1 : 0;
      EXPECT_EQ(rim, 2 * around);
      EXPECT_EQ(frame.vertices - mesh.edges.size() + frame.triangles, 0); // a tube
    }
  }
}

// A ring of a cone about the z axis, or a part of it, of the radius 1 where liquid enters, twice that outside.
Frame fan(std::uint32_t edges, double angle) {
  const bool closed = angle == 2 * std::numbers::pi;
  const std::uint32_t n = closed ? edges : edges + 1;
  std::vector<Vector3> x;
  std::vector<Corners> t;
  std::vector<std::uint32_t> border;
  for (std::uint32_t j = 0; j < 2; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double at = angle * i / edges, r = 1 + j;
      x.emplace_back(r * std::cos(at), r * std::sin(at), -0.5 * j);
    }
  for (std::uint32_t i = 0; i < edges; ++i) {
    const std::uint32_t next = (i + 1) % n;
    t.push_back({i, n + i, n + next});
    t.push_back({i, n + next, next});
  }
  for (std::uint32_t i = 0; i < n; ++i)
    border.push_back(i);
  Frame frame = make_frame(x, t, std::vector<double>(t.size(), 0.1));
  mark_inlet(frame, border);
  return frame;
}

// Where liquid fans out as much enters through each edge as flows through it, to round-off, and thins as the ring that
// it makes gets longer; each vertex goes straight on the way on which it has entered.
TEST(Emit, FansOutOfARingOrAnArc) {
  const Scene scene = parse_scene("[sheet]\nshape = \"annulus\"\ninner_radius = 1\nouter_radius = 2\nplane = \"xy\"\n"
                                  "edge_length = 0.5\nthickness = 0.25\n[material]\nviscosity = 1\ndensity = 1\n"
                                  "[inflow]\nregion = \"inner_rim\"\nradial_velocity = 1\nvelocity = [0, 0, -0.5]\n",
                                  "scene");
  for (const double angle : {2 * std::numbers::pi, 2.0})
    for (const std::uint32_t edges : {24U, 25U}) {
      Frame frame = fan(edges, angle);
      const double start = volume_of(frame), half = angle / edges / 2;
      const double flux = thickness * edges * 2 * std::sin(half) * std::hypot(std::cos(half), 0.5);
      for (const double dt : {0.05, 0.03, 0.5, 0.2, 1e-9, 0.3, 0.9, 0.02, 0.7}) {
        move(frame, scene, dt);
        const double before = volume_of(frame);
        const double entered = emit(frame, scene).volume;
        ASSERT_EQ(value_error(frame), "");
        EXPECT_NEAR(volume_of(frame) - before, entered, 1e-13 * start);
      }
      EXPECT_NEAR(volume_of(frame), start + account(frame), 1e-13 * start);
      EXPECT_NEAR(account(frame), flux * frame.time, 2e-3 * flux * frame.time); // the first strip is no step's
      double worst = 0;
      for (std::size_t t = 0; t < frame.triangles; ++t) {
        Vector3 middle = Vector3::Zero();
        for (const std::uint32_t v : triangles(frame)[t])
          middle += positions(frame)[v] / 3;
        const double r = middle.head<2>().norm();
        if (r < 1 + frame.time) // behind what was there
          worst = std::max(worst, std::abs(volumes(frame)[t] / test::area(frame, t) / (thickness / r) - 1));
      }
      EXPECT_LT(worst, 0.05) << edges;
      for (std::size_t v = 0; v < frame.vertices; ++v) {
        const Vector3& x = positions(frame)[v];
        if (x.head<2>().norm() < 1 + frame.time) {
          EXPECT_NEAR(x.z(), -0.5 * (x.head<2>().norm() - 1), 1e-12);
        }
      }
      EXPECT_GT(frame.vertices, 5 * edges);
    }
}

TEST(Emit, AFanThatWouldFlowOutOfTheSheetIsRefused) {
  const Scene scene = parse_scene("[sheet]\nshape = \"annulus\"\ninner_radius = 1\nouter_radius = 2\nplane = \"xy\"\n"
                                  "edge_length = 0.5\nthickness = 0.25\n[material]\nviscosity = 1\ndensity = 1\n"
                                  "[inflow]\nregion = \"inner_rim\"\nradial_velocity = -1\n",
                                  "scene");
  Frame frame = fan(12, 2 * std::numbers::pi);
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("points out of the sheet at the inlet's edge"));
}

TEST(Emit, OpenAndClosedPiecesTogether) {
  Frame frame = tube(6);
  // A square behind the tube, its upper border in the inlet, too.
  std::vector<Vector3> x(positions(frame).begin(), positions(frame).end());
  std::vector<Corners> t(triangles(frame).begin(), triangles(frame).end());
  const auto n = static_cast<std::uint32_t>(x.size());
  for (const Vector3& p : {Vector3(5, 0, 0), Vector3(6, 0, 0), Vector3(6, 0, 1), Vector3(5, 0, 1)})
    x.push_back(p);
  t.push_back({n, n + 1, n + 2});
  t.push_back({n, n + 2, n + 3});
  frame = make_frame(x, t, std::vector<double>(t.size(), 0.1));
  mark_inlet(frame, {6, 7, 8, 9, 10, 11, n + 2, n + 3});
  const Scene scene = scene_of("[0, 0, -1]");
  const double start = volume_of(frame);
  for (int i = 0; i < 30; ++i) {
    move(frame, scene, 0.1);
    emit(frame, scene);
  }
  EXPECT_NEAR(volume_of(frame), start + thickness * (6 + 1) * frame.time, 1e-12); // a hexagon of side 1, and 1
  EXPECT_EQ(value_error(frame), "");
}

// Under a layer twice as thick as what enters the inlet takes up its depth, and rises to its middle; as much liquid
// enters as before, slower. When the layer has run away, all is as the scene has it.
TEST(Emit, ADrownedInletLetsInAsMuch) {
  const Scene scene =
      scene_of("[0, -1, 0]", "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -0.125]\n"
                             "contact = \"flow\"\n");
  const solid::Solids solids(scene);
  Frame frame = curtain();
  put_touched_solids(frame, std::vector<std::int32_t>(frame.vertices, 0), 1);
  for (double& volume : volumes(frame))
    volume *= 2;
  const double start = volume_of(frame);
  const auto flow = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      move(frame, scene, 0.1);
      emit(frame, scene);
      drown_inlets(frame, scene, solids);
      if (frame.time > 0.51) {
        EXPECT_NEAR(volume_of(frame), start + thickness * 4 * frame.time, 1e-13 * start) << frame.time;
      }
      EXPECT_EQ(value_error(frame), "");
    }
  };
  flow(25);
  const double depth = scene::inlet_depth(frame, scene, 0);
  EXPECT_GT(depth, 1.3 * thickness);
  EXPECT_LE(depth, 2 * thickness);
  const InletChain chain = find_inlet(frame, 0).front();
  const std::vector<double> depths = scene::inlet_depths(frame, scene, 0, chain.border);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    EXPECT_GT(depths[i], (i == 0 || i + 1 == depths.size() ? 1.3 : 1.5) * thickness);
    EXPECT_LE(depths[i], 2 * thickness);
    for (const std::uint32_t v : {chain.border[i], chain.row[i]})
      EXPECT_NEAR(positions(frame)[v].z(), (depths[i] - thickness) / 2, 1e-15);
  }
  EXPECT_LT(depths.front(), depths[1]); // beside the ends liquid runs away
  for (std::size_t t = 0; t < frame.triangles; ++t)
    volumes(frame)[t] = thickness / 2 * test::area(frame, t);
  drown_inlets(frame, scene, solids);
  EXPECT_LT(scene::inlet_depth(frame, scene, 0), depth);
  for (int k = 0; k < 20; ++k)
    drown_inlets(frame, scene, solids);
  EXPECT_NEAR(scene::inlet_depth(frame, scene, 0), thickness, 1e-15);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    if (masks(frame, "inlet")[v] != 0) {
      EXPECT_NEAR(positions(frame)[v].z(), 0, 1e-15);
    }
}

// Beside a drowned inlet the rim goes back to beside the strip's first row, along the wall, and no longer backwards;
// what is more than half of the strip's width behind stays, as all does where the inlet is not drowned.
TEST(Emit, TheRimBesideADrownedInletStaysBeforeIt) {
  const Scene scene =
      scene_of("[0, -1, 0]", "[[solid]]\nshape = \"plane\"\nnormal = [0, 0, 1]\ncenter = [0, 0, -0.125]\n"
                             "contact = \"flow\"\n");
  const solid::Solids solids(scene);
  Frame frame = curtain();
  move(frame, scene, 1);
  emit(frame, scene);
  put_touched_solids(frame, std::vector<std::int32_t>(frame.vertices, 0), 1);
  const InletChain chain = find_inlet(frame, 0).front();
  ASSERT_FALSE(chain.row.empty());
  const std::uint32_t row = chain.row.front(), border = chain.border.front();
  const auto beside = [&](std::uint32_t v) {
    return masks(frame, "inlet")[v] == 0 && std::abs(positions(frame)[v].x() - positions(frame)[row].x()) < 1e-9;
  };
  std::uint32_t rim = 0; // next to the row
  double highest = -1e9;
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    if (beside(v) && positions(frame)[v].y() > highest)
      highest = positions(frame)[rim = v].y();
  const double width = positions(frame)[border].y() - positions(frame)[row].y();
  ASSERT_GT(width, 0);
  const double outwards = positions(frame)[row].x() < 2 ? -1 : 1;
  const auto held = [&](double behind, const std::function<void(Frame&)>& bend = {}) {
    Frame moved = frame;
    if (bend)
      bend(moved);
    positions(moved)[rim] = positions(moved)[row] + Vector3(outwards, behind * width, 0);
    velocities(moved)[rim] = {0.5, 2, 0};
    hold_banks(moved, scene, solids);
    return std::pair(Vector3(positions(moved)[rim] - positions(moved)[row]), Vector3(velocities(moved)[rim]));
  };
  EXPECT_LT((held(0.3).first - Vector3(outwards, 0.3 * width, 0)).norm(), 1e-12); // not drowned
  EXPECT_EQ(held(0.3).second, Vector3(0.5, 2, 0));
  scene::put_inlet_depth(frame, scene, 0, 2 * thickness);
  EXPECT_LT((held(0.3).first - Vector3(outwards, 0, 0)).norm(), 1e-12);
  EXPECT_LT((held(0.3).second - Vector3(0.5, 0, 0)).norm(), 1e-12);
  for (const double untouched : {0.6, -0.2})
    EXPECT_LT((held(untouched).first - Vector3(outwards, untouched * width, 0)).norm(), 1e-12);
  // What follows on the rim is held, too, where the rim first goes on before the row.
  std::uint32_t onwards = rim;
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    if (beside(v) && v != rim && (onwards == rim || positions(frame)[v].y() > positions(frame)[onwards].y()))
      onwards = v;
  const auto following = [&](double before) {
    Frame moved = frame;
    positions(moved)[rim] = positions(moved)[row] + Vector3(outwards, -before * width, 0);
    positions(moved)[onwards] = positions(moved)[row] + Vector3(2 * outwards, 0.3 * width, 0);
    hold_banks(moved, scene, solids);
    return positions(moved)[onwards].y() - positions(moved)[row].y();
  };
  EXPECT_NEAR(following(0.2), 0, 1e-12);
  EXPECT_NEAR(following(0.6), 0.3 * width, 1e-12);
  // Where another part of the sheet stands in the way, nothing moves.
  const Vector3 way = positions(frame)[row] + Vector3(0.7 * outwards, -0.05 * width, 0);
  const auto standing = [&](Frame& bent) {
    const auto x = positions(bent);
    const Corners& far =
        *std::ranges::max_element(triangles(bent), {}, [&](const Corners& c) { return (x[c[0]] - x[rim]).norm(); });
    x[far[0]] = way + Vector3(0, 0, 0.1);
    x[far[1]] = way + Vector3(0.01, 0, -0.1);
    x[far[2]] = way + Vector3(-0.01, 0, -0.1);
  };
  EXPECT_LT((held(0.3, standing).first - Vector3(outwards, 0.3 * width, 0)).norm(), 1e-12);
  EXPECT_EQ(held(0.3, standing).second, Vector3(0.5, 2, 0));
}

TEST(Emit, WhatHasMovedMeetsTheRestOrDoesNot) {
  std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.3, 0.2, 1}, {0.2, 0.3, 0.5}};
  const std::vector<Corners> t{{0, 1, 2}, {3, 4, 5}};
  std::vector<bool> moved(6, false);
  moved[5] = true;
  EXPECT_FALSE(moved_triangles_cross(x, t, moved));
  x[5].z() = -0.5;
  EXPECT_TRUE(moved_triangles_cross(x, t, moved));
  moved[5] = false;
  EXPECT_FALSE(moved_triangles_cross(x, t, moved)); // nobody asks
}

TEST(Emit, OneTriangle) {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}};
  const std::vector<Corners> t{{0, 2, 1}};
  Frame frame = make_frame(x, t, std::vector<double>{1});
  mark_inlet(frame, {0, 1});
  const Scene scene = scene_of("[0, -1, 0]");
  move(frame, scene, 10);
  emit(frame, scene);
  EXPECT_NEAR(volume_of(frame), 1 + thickness * 10, 1e-14);
  EXPECT_EQ(value_error(frame), "");
}

TEST(Emit, TheSameAtAnyScale) {
  for (const double scale : {1e-6, 1e3}) {
    Frame small = curtain(), large = curtain();
    for (Vector3& x : positions(large))
      x *= scale;
    for (Vector3& x : large.find("inlet_origin")->values<Vector3>())
      x *= scale;
    const Scene slow = scene_of("[0, -1, 0]"), fast = scene_of("[0, " + std::to_string(-scale) + ", 0]");
    for (int i = 0; i < 40; ++i) {
      move(small, slow, 0.125);
      move(large, fast, 0.125);
      emit(small, slow);
      emit(large, fast);
    }
    EXPECT_EQ(small.vertices, large.vertices);
    EXPECT_NEAR(account(large) / (scale * scale) / account(small), 1, 1e-12);
  }
}

TEST(Emit, WhatCannotFlowInIsRefused) {
  Frame frame = curtain();
  const auto refusal = [&](const std::string& velocity) { return error_of([&] { emit(frame, scene_of(velocity)); }); };
  EXPECT_THAT(refusal("[0, 1, 0]"), HasSubstr("points out of the sheet at the inlet's edge"));
  EXPECT_THAT(refusal("[[0, 0, -1, 0], [5, 0, 1, 0]]"), HasSubstr("at 5 s"));
  EXPECT_THAT(refusal("[1, 0, 0]"), HasSubstr("runs along the inlet's edge"));
  EXPECT_EQ(frame, curtain());
  // A ring in the plane of flow: half of it would flow out.
  Frame ring = tube(8);
  EXPECT_THAT(error_of([&] { emit(ring, scene_of("[0, 0, 1]")); }), HasSubstr("points out of the sheet"));
}

TEST(Emit, WhatIsTurnedOverAtTheInletIsSaidSo) {
  Frame frame = curtain();
  const Scene scene = scene_of("[0, -1, 0]");
  const auto turned_over = [&](Frame sheet) {
    double inlet = 0;
    for (const Vector3& x : positions(sheet))
      inlet = std::max(inlet, x.y());
    for (Vector3& x : positions(sheet))
      x.y() = 2 * inlet - x.y();
    return error_of([&] { emit(sheet, scene); });
  };
  EXPECT_THAT(turned_over(frame), HasSubstr("choose the border at the other side"));
  frame.step = 1;
  EXPECT_THAT(turned_over(frame), HasSubstr("the sheet was turned over there before anything had entered"));
  for (int i = 0; i < 8; ++i) { // a row
    move(frame, scene, 0.125);
    emit(frame, scene);
  }
  EXPECT_THAT(turned_over(frame), HasSubstr("what has flowed in was turned over there, as by a solid"));
}

TEST(Emit, AnInletThatIsNotThereIsSaidSo) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = test::grid(4, 2, 1, thickness);
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("make it with sheet-init"));
  mark_inlet(frame, {});
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("the inlet is gone"));
  mark_inlet(frame, {10}); // no edge
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("the inlet is gone"));
  mark_inlet(frame, {5, 6, 7}); // inside
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("the inlet is gone"));
  frame.erase("inlet_origin");
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("inlet_origin"));
  Frame empty = make_frame({}, {}, {});
  mark_inlet(empty, {});
  EXPECT_THAT(error_of([&] { emit(empty, scene); }), HasSubstr("the inlet is gone"));
}

TEST(Emit, ABowTieAtTheInletIsRefused) {
  const std::vector<Vector3> x{{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {3, -1, 0}, {4, 0, 0}};
  const std::vector<Corners> t{{0, 1, 2}, {2, 3, 4}};
  Frame frame = make_frame(x, t, std::vector<double>{1, 1});
  mark_inlet(frame, {0, 2, 4}); // one line: 4 -> 2 -> 0
  const Scene scene = scene_of("[0, -1, 0]");
  move(frame, scene, 3);
  emit(frame, scene);
  EXPECT_NEAR(volume_of(frame), 2 + thickness * 4 * 3, 1e-13);
  // Two sheets that hang from one vertex.
  const std::vector<Vector3> y{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0.5, -1, 0}, {1.5, -1, 0}, {1, 0, 1}, {1, -1, 1}};
  const std::vector<Corners> s{{1, 0, 3}, {2, 1, 4}, {1, 5, 6}};
  frame = make_frame(y, s, std::vector<double>{1, 1, 1});
  mark_inlet(frame, {0, 1, 2, 5});
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("pinched"));
}

TEST(Emit, AHeldInletIsRefusedAHeldSideGoesOn) {
  const std::string hold = "[[hold]]\nregion = \"rim\"\n";
  Frame frame = curtain();
  const auto bits = put_masks(frame, "hold");
  std::ranges::fill(bits, 1);
  EXPECT_THAT(error_of([&] { emit(frame, scene_of("[0, -1, 0]", hold)); }),
              HasSubstr("[[hold]] number 0 (from 0) holds the whole inlet along y"));
  EXPECT_EQ(error_of([&] { emit(frame, scene_of("[0, -1, 0]", hold + "axes = \"xz\"\n")); }), "");
  // An inlet cannot move, along whatever axis; solids can.
  const auto moved = [&](const std::string& velocity) {
    return error_of([&] {
      emit(frame, scene_of("[0, -1, 0]",
                           hold + "axes = \"xz\"\nmotion = {kind = \"translating\", velocity = " + velocity + "}\n"));
    });
  };
  EXPECT_THAT(moved("[0.1, 0, 0]"), HasSubstr("moves the whole inlet"));
  EXPECT_THAT(moved("[0.1, 0, 0]"), HasSubstr("([[solid]] velocity = [-0.1, 0, 0])"));
  EXPECT_EQ(moved("[0, 0.1, 0]"), ""); // not held along y
  const Scene late = scene_of("[0, -1, 0]", hold + "until = 1\n");
  frame.time = 1;
  EXPECT_EQ(error_of([&] { emit(frame, late); }), "");
  // One side is a guide: the new vertices at that side are in it.
  std::ranges::fill(bits, 0);
  bits[10] = bits[5] = bits[0] = 1;
  frame.time = 0;
  const Scene guided = scene_of("[0, -1, 0]", hold);
  move(frame, guided, 2.75);
  emit(frame, guided);
  EXPECT_EQ(frame.vertices, 15 + 3 * 5);
  EXPECT_EQ(std::ranges::count(masks(frame, "hold"), 1), 3 + 3);
}

TEST(Emit, UntilItEnds) {
  const Scene scene = scene_of("[0, -1, 0]", "until = 2.25\n");
  Frame frame = curtain();
  for (const double dt : {0.75, 0.75, 0.75}) {
    move(frame, scene, dt);
    emit(frame, scene);
  }
  EXPECT_NEAR(volume_of(frame), thickness * (8 + 4 * 2.25), 1e-14);
  EXPECT_EQ(frame.find("inlet"), nullptr);
  EXPECT_EQ(frame.find("inlet_origin"), nullptr);
  const Frame end = frame;
  emit(frame, scene);
  EXPECT_EQ(frame, end);
}

TEST(Emit, GoesOnWhereSomebodyHasRemeshedTheStrip) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = curtain();
  const double start = volume_of(frame);
  move(frame, scene, 1);
  emit(frame, scene);
  // The first edge of the border is split in the middle, as a remesher would.
  const auto old = triangles(static_cast<const Frame&>(frame));
  const auto bits = masks(frame, "inlet");
  std::uint32_t t = 0;
  std::size_t i = 0;
  for (std::uint32_t k = 0; k < old.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      if (bits[old[k][c]] == 3 && bits[old[k][(c + 1) % 3]] == 3) {
        t = k;
        i = c;
      }
  const std::uint32_t a = old[t][i], b = old[t][(i + 1) % 3], c = old[t][(i + 2) % 3];
  std::vector<Corners> corners(old.begin(), old.end());
  corners[t] = {a, static_cast<std::uint32_t>(frame.vertices), c};
  corners.push_back({static_cast<std::uint32_t>(frame.vertices), b, c});
  Lineage vertices, kept;
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    vertices.keep(v);
  const std::vector<Parent> ends{{a, 0.5, 0}, {b, 0.5, 0}};
  vertices.add(ends);
  for (std::uint32_t k = 0; k < frame.triangles; ++k) {
    const Parent half{k, 1, k == t ? 0.5 : 1};
    kept.add({&half, 1});
  }
  const Parent half{t, 1, 0.5};
  kept.add({&half, 1});
  transfer_frame(frame, vertices, kept, corners);
  ASSERT_EQ(value_error(frame), "");
  for (int k = 0; k < 30; ++k) {
    move(frame, scene, 0.1);
    emit(frame, scene);
    EXPECT_EQ(value_error(frame), "");
    EXPECT_NEAR(volume_of(frame), start + account(frame), 1e-13);
  }
  EXPECT_NEAR(account(frame), thickness * 4 * 4, 1e-13);
  EXPECT_EQ(count(frame, in_inlet | at_inlet_border), 6);
  EXPECT_EQ(count(frame, behind_inlet), 6);
}

// Before there is a strip, it may remesh the border: then rows are as long as its edges.
TEST(Emit, TheRemesherLeavesTheStripAlone) {
  const Scene scene = scene_of("[0, -1, 0]");
  for (const double edge : {0.25, 1.0, 4.0}) {
    Frame frame = curtain();
    const double start = volume_of(frame);
    std::size_t border = 0;
    for (int k = 1; k <= 60; ++k) {
      move(frame, scene, 0.1);
      emit(frame, scene);
      const bool has_strip = count(frame, behind_inlet) > 0;
      remesh::Options options;
      options.size.edge_length = edge;
      remesh::remesh(frame, nullptr, options);
      ASSERT_EQ(value_error(frame), "");
      EXPECT_NEAR(volume_of(frame), start + (has_strip ? thickness * 4 * frame.time : 0), 1e-12) << edge << " " << k;
      if (border == 0 && has_strip)
        border = count(frame, behind_inlet);
      EXPECT_EQ(count(frame, behind_inlet), border);
      if (has_strip) {
        EXPECT_EQ(count(frame, in_inlet | at_inlet_border), border);
      }
    }
    EXPECT_EQ(border, edge < 1 ? 17 : edge > 1 ? 2 : 5) << edge;
  }
}

TEST(Emit, AmountsStayWithTheOldLiquid) {
  const Scene scene = scene_of("[0, -1, 0]");
  Frame frame = curtain();
  formats::Array dye = formats::make_array("dye", formats::Place::triangle, formats::Type::float64, 1, "kg",
                                           formats::Transfer::conserve, frame.triangles);
  std::ranges::fill(dye.values<double>(), 1.0);
  frame.put(dye);
  formats::Array mass = formats::make_array("mass", formats::Place::vertex, formats::Type::float64, 1, "kg",
                                            formats::Transfer::conserve, frame.vertices);
  std::ranges::fill(mass.values<double>(), 1.0);
  frame.put(mass);
  for (int k = 0; k < 30; ++k) {
    move(frame, scene, 0.1);
    emit(frame, scene);
    if (k == 7) // something falls into the strip
      std::ranges::fill(frame.find("dye")->values<double>(), 2.0);
    EXPECT_NEAR(test::total(frame.find("dye")->values<double>()), k < 7 ? 16 : 2 * (16 + 8), 1e-12) << k;
  }
  EXPECT_EQ(test::total(frame.find("mass")->values<double>()), 15);
}

TEST(Emit, HugeStepsAreRefusedNotTried) {
  const Scene scene = scene_of("[0, -1e9, 0]");
  Frame frame = curtain();
  move(frame, scene, 1);
  EXPECT_THAT(error_of([&] { emit(frame, scene); }), HasSubstr("smaller steps"));
}

// Two inlets with their own velocities, one of which ends, and a sheet that enters: each is as it would be alone, one
// behind the other in the frame.
TEST(Emit, SeveralInletsAndSheets) {
  const std::string left = "shape = \"rectangle\"\nsize = [4, 2]\nsegments = [4, 2]\npattern = \"structured\"\n"
                           "thickness = 0.25\n",
                    right = left + "center = [10, 0, 0]\n", late = left + "center = [20, 0, 0]\nenters = 1.5\n",
                    liquid = "[material]\nviscosity = 1\ndensity = 1\n";
  const Scene both = parse_scene("[[sheet]]\nname = \"a\"\n" + left + "[[sheet]]\nname = \"b\"\n" + right +
                                     "[[sheet]]\nname = \"c\"\n" + late + liquid +
                                     "[[inflow]]\nsheet = \"a\"\nregion = \"z_max\"\nvelocity = [0, 0, -1]\nuntil = 2\n"
                                     "[[inflow]]\nsheet = \"b\"\nregion = \"z_max\"\nvelocity = [0, 0, -2]\n",
                                 "scene");
  const Scene one = parse_scene(
      "[sheet]\n" + left + liquid + "[inflow]\nregion = \"z_max\"\nvelocity = [0, 0, -1]\nuntil = 2\n", "scene");
  const Scene other =
      parse_scene("[sheet]\n" + right + liquid + "[inflow]\nregion = \"z_max\"\nvelocity = [0, 0, -2]\n", "scene");
  Frame all = build_frame(both), a = build_frame(one), b = build_frame(other);
  EXPECT_EQ(all.vertices, a.vertices + b.vertices);
  EXPECT_EQ(positions(all)[a.vertices], positions(b)[0]);
  const std::size_t at_start = all.vertices;
  double entered_late = 0;
  for (int k = 1; k <= 10; ++k) {
    const double dt = 0.3;
    const auto x = positions(all);
    // As the solver would move them: what belongs to b, then the rest (c rests).
    for (std::size_t v = 0; v < all.vertices; ++v)
      if (std::abs(x[v].x()) < 15)
        x[v].z() -= (x[v].x() > 5 ? 2 : 1) * dt;
    for (Vector3& y : positions(a))
      y.z() -= dt;
    for (Vector3& y : positions(b))
      y.z() -= 2 * dt;
    all.time = a.time = b.time = k * dt;
    entered_late += let_enter(all, both);
    emit(all, both);
    emit(a, one);
    emit(b, other);
    EXPECT_EQ(entered_late > 0, all.time >= 1.5);
  }
  EXPECT_GT(a.vertices, 20U);
  EXPECT_EQ(all.vertices, a.vertices + b.vertices + 15);
  EXPECT_GT(all.vertices, at_start);
  EXPECT_NEAR(volume_of(all), volume_of(a) + volume_of(b) + 2, 1e-12);
  EXPECT_NEAR(account(all), account(a) + account(b) + 2, 1e-12);
  EXPECT_EQ(number(all, "entered", 0), 1);
  EXPECT_NE(all.find("inlet"), nullptr); // b's
  const auto inlet = masks(all, "inlet");
  for (std::size_t v = 0; v < inlet.size(); ++v)
    EXPECT_EQ(of_inlet(inlet[v], 0), 0U); // a's is released
  EXPECT_EQ(formats::find_value_error(all), "");
  EXPECT_EQ(a.find("inlet"), nullptr);
  for (const double count : {-1.0, std::nan("")}) {
    put_number(all, "entered", "1", count);
    EXPECT_THROW(static_cast<void>(let_enter(all, both)), Error);
  }
}

} // namespace
} // namespace sheet::flow
