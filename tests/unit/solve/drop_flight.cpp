// SPDX-License-Identifier: GPL-3.0-or-later
// Drops that fly: parabolas, and falls in air.
#include <cmath>

#include <gtest/gtest.h>

#include "libsheet/scene/read.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/drop_flight.h"

namespace sheet {
namespace {

constexpr double radius = 1e-3; // [m]

// One parabola, whatever the steps.
TEST(DropFlight, FollowsAParabola) {
  const DropForces forces{.gravity = {0, -9.81, 0}};
  const DropMotion start{{0.1, 0.2, 0.3}, {1, 2, -0.5}};
  constexpr double time = 0.7;
  const Vector3 place(0.1 + time, 0.2 + 2 * time - 9.81 / 2 * time * time, 0.3 - 0.5 * time),
      velocity(1, 2 - 9.81 * time, -0.5);
  for (const int steps : {1, 7, 1000}) {
    DropMotion at = start;
    for (int i = 0; i < steps; ++i)
      at = flown(at, radius, time / steps, forces);
    EXPECT_NEAR((at.position - place).norm(), 0, 1e-15 * steps) << steps;
    EXPECT_NEAR((at.velocity - velocity).norm(), 0, 4e-15 * steps) << steps;
  }
}

// Without weight v = v0/(1 + k v0 t), with it v = v∞ tanh(g t/v∞), v∞ = sqrt(g/k), k = drag/radius.
TEST(DropFlight, IsSlowedByAir) {
  const double k = 0.2 / radius;
  const DropMotion slowed = flown({Vector3::Zero(), {3, 0, 0}}, radius, 0.1, {.drag = 0.2});
  EXPECT_NEAR(slowed.velocity.x(), 3 / (1 + k * 3 * 0.1), 1e-6 * 3);
  EXPECT_NEAR(slowed.position.x(), std::log1p(k * 3 * 0.1) / k, 1e-6 * std::log1p(k * 3 * 0.1) / k);
  const double limit = std::sqrt(9.81 / k);
  for (const double t : {0.01, 0.05, 1.0}) {
    const DropMotion fallen =
        flown({Vector3::Zero(), {0, 0, 0.5}}, radius, t, {.gravity = {0, 0, -9.81}, .wind = {0, 0, 0.5}, .drag = 0.2});
    EXPECT_NEAR(fallen.velocity.z(), 0.5 - limit * std::tanh(9.81 * t / limit), 1e-6 * limit) << t;
  }
}

TEST(DropFlight, MovesWhatFliesOnly) {
  const Scene scene = parse_scene("[sheet]\nshape = \"disk\"\nradius = 1\nedge_length = 0.5\nthickness = 0.1\n"
                                  "[material]\nviscosity = 1\ndensity = 1000\n"
                                  "[environment]\ngravity = [0, 0, -10]\nair = {density = 1.2}\n",
                                  "scene");
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Corners> t{{0, 1, 2}};
  formats::Frame frame = make_frame(x, t, std::vector<double>{1e-3});
  frame.time = 0.5;
  fly_drops(frame, scene, 0);
  EXPECT_FALSE(knows_drops(frame));
  write_drops(frame, std::vector<Drop>{{.position = {0, 0, 1}, .volume = 1e-6}, {.volume = 1e-6, .touch = 1}});
  fly_drops(frame, scene, 0);
  const std::vector<Drop> drops = read_drops(frame);
  EXPECT_LT(drops[0].velocity.z(), -4.5);
  EXPECT_GT(drops[0].velocity.z(), -5); // slowed by air
  EXPECT_EQ(drops[1].position, Vector3::Zero());
  EXPECT_EQ(frame.find("drop_start_position")->values<Vector3>()[0], Vector3(0, 0, 1));
  EXPECT_EQ(formats::find_value_error(frame), "");
}

} // namespace
} // namespace sheet
