// SPDX-License-Identifier: GPL-3.0-or-later
// Drops that land, on sheets and on solids that move.
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "libsheet/collide/drop_landing.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/drops.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::collide {
namespace {

using formats::Frame;
using test::volume_of;

constexpr double duration = 0.1; // [s]

Scene landing_scene(const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [4, 2]\nedge_length = 1\nthickness = 0.25\n"
                     "[material]\nviscosity = 1\ndensity = 1000\n[tear]\ndrops = true\n" +
                         more,
                     "scene");
}

// A sheet of 8 x 8 squares that has moved at `velocity` in a step, and drops behind their ways.
Frame after_step(const Vector3& velocity, std::span<const Drop> drops) {
  Frame frame = test::grid(8, 8, 1, 0.2);
  formats::Array start = formats::make_standard_array("start_position", frame.vertices);
  std::ranges::copy(positions(frame), start.values<Vector3>().begin());
  frame.put(std::move(start));
  put_number(frame, "start_time", 0);
  frame.time = duration;
  for (std::size_t v = 0; v < frame.vertices; ++v) {
    velocities(frame)[v] = velocity + Vector3(0, 0, 1e-3 * static_cast<double>(v % 7));
    positions(frame)[v] += duration * velocity;
  }
  write_drops(frame, drops);
  formats::Array starts = formats::make_standard_array("drop_start_position", drops.size());
  for (std::size_t i = 0; i < drops.size(); ++i)
    starts.values<Vector3>()[i] = drops[i].position - duration * drops[i].velocity;
  frame.put(std::move(starts));
  return frame;
}

Vector3 momentum_of_all(const Frame& frame) {
  Vector3 p = test::momentum(frame);
  for (const Drop& drop : read_drops(frame))
    p += drop.volume * drop.velocity;
  return p;
}

Drop ball(double r, const Vector3& at, const Vector3& velocity) {
  return {.position = at, .velocity = velocity, .volume = 4 * std::numbers::pi / 3 * r * r * r};
}

// However fast it goes through a sheet that comes towards it.
TEST(DropLanding, AMovingSheetTakesDropsUp) {
  const std::vector<Drop> drops{ball(0.1, {3.3, 4.1, -50}, {0, 0, -600}), ball(0.7, {5, 5, 0.6}, {1, 2, -3}),
                                ball(0.1, {4, 4, 3}, {0, 0, 1}), ball(0.1, {20, 4, -1}, {0, 0, -30})};
  Frame frame = after_step({0.5, 0, 2}, drops);
  const double volume = volume_of(frame) + volume_of_drops(frame);
  const Vector3 before = momentum_of_all(frame);
  const Landed landed = land_drops(frame, landing_scene(), nullptr);
  EXPECT_EQ(landed.on_sheet, 2U);
  EXPECT_EQ(read_drops(frame).size(), 2U); // one goes away, one passes beside
  EXPECT_NEAR((volume_of(frame) + volume_of_drops(frame)) / volume, 1, 1e-14);
  EXPECT_NEAR((momentum_of_all(frame) - before).norm(), 0, 1e-14 * before.norm());
  EXPECT_EQ(test::value_error(frame), "");
  std::size_t thicker = 0;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    thicker += volumes(frame)[t] > 0.2 * test::area(frame, t) * 1.001 ? 1 : 0;
  EXPECT_GT(thicker, 3U); // that of the large drop spreads
  EXPECT_LT(thicker, 12U);
}

// What has just come off is too near, and stays off as long as it does not come nearer.
TEST(DropLanding, ADropThatComesOffStaysOff) {
  Frame leaving = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, {4, 4, 0.3}, {0, 0, 1})});
  EXPECT_EQ(land_drops(leaving, landing_scene(), nullptr).on_sheet, 0U);
  Frame resting = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, {4, 4, 0.3}, {0, 0, 0})});
  EXPECT_EQ(land_drops(resting, landing_scene(), nullptr).on_sheet, 0U);
  Frame falling = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, {4, 4, 0.01}, {0, 0, -1})});
  EXPECT_EQ(land_drops(falling, landing_scene(), nullptr).on_sheet, 1U);
}

TEST(DropLanding, SolidsTakeDropsAlong) {
  const Scene on = landing_scene("[[solid]]\nshape = \"box\"\nsize = [20, 20, 2]\ncenter = [0, 0, -11]\n"
                                 "motion = {kind = \"translating\", velocity = [2, 0, 0]}\n");
  const solid::Solids solids(on);
  Frame frame = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, {1, 1, -60}, {0, 0, -500})});
  const Landed landed = land_drops(frame, on, &solids);
  EXPECT_EQ(landed.on_sheet, 0U);
  ASSERT_EQ(landed.on_solids, 1U);
  Drop drop = read_drops(frame)[0];
  EXPECT_EQ(drop.touch, 1U);
  EXPECT_NEAR(drop.position.z(), -9.5, 1e-9); // on its upper side
  EXPECT_EQ(drop.velocity, Vector3(2, 0, 0));
  // And in the next step.
  formats::Array starts = formats::make_standard_array("drop_start_position", 1);
  starts.values<Vector3>()[0] = drop.position;
  frame.put(std::move(starts));
  put_number(frame, "start_time", duration);
  frame.time = 2 * duration;
  EXPECT_EQ(land_drops(frame, on, &solids).on_solids, 0U);
  EXPECT_NEAR((read_drops(frame)[0].position - drop.position - Vector3(2 * duration, 0, 0)).norm(), 0, 1e-12);
}

// Layers of two liquids stay two: the drop is stopped, and lies there in the next step, too.
TEST(DropLanding, ASheetOfAnotherLiquidStopsDrops) {
  const Scene two = parse_scene("[[sheet]]\nshape = \"disk\"\nradius = 1\nedge_length = 0.5\nthickness = 0.1\n"
                                "[[sheet]]\nshape = \"disk\"\nradius = 1\nedge_length = 0.5\nthickness = 0.1\n"
                                "[sheet.material]\nviscosity = 1\ndensity = 2000\n"
                                "[material]\nviscosity = 1\ndensity = 1000\n[tear]\ndrops = true\n",
                                "scene");
  std::vector<Drop> drops{ball(0.3, {4.2, 4.1, -0.5}, {1, 0, -9})};
  drops[0].liquid = 1;
  Frame frame = after_step({0, 0, 0.5}, drops);
  frame.put(formats::make_standard_array("liquid", frame.triangles));
  write_drops(frame, drops);
  formats::Array starts = formats::make_standard_array("drop_start_position", 1);
  starts.values<Vector3>()[0] = drops[0].position - duration * drops[0].velocity;
  frame.put(starts);
  const auto all = [&] {
    const Drop drop = read_drops(frame)[0];
    return Vector3(1000 * test::momentum(frame) + 2000 * drop.volume * drop.velocity);
  };
  const Vector3 before = all();
  const double volume = volume_of(frame);
  EXPECT_EQ(land_drops(frame, two, nullptr).on_sheet, 0U);
  const Drop drop = read_drops(frame)[0];
  EXPECT_EQ(volume_of(frame), volume);
  EXPECT_NEAR((all() - before).norm(), 0, 1e-13 * before.norm());
  EXPECT_GT(drop.velocity.z(), -5);
  EXPECT_GT(drop.position.z() - duration * 0.5, 0.39); // above the sheet, by its radius and half the thickness
}

// As a ball on its surface, at rest.
TEST(DropLanding, ABathBearsDrops) {
  const Scene on = landing_scene("[environment]\ngravity = [0, 0, -9.81]\nbath = {density = 1500, level = -20}\n");
  Frame frame = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, {1, 1, -60}, {0, 0, -500})});
  EXPECT_EQ(land_drops(frame, on, nullptr).on_solids, 1U);
  const Drop drop = read_drops(frame)[0];
  EXPECT_EQ(drop.touch, 1U);
  EXPECT_NEAR(drop.position.z(), -19.5, 1e-12);
  EXPECT_EQ(drop.velocity, Vector3::Zero());
}

// The sheet is 0.2 thick: under 0.15 of the bath it floats and has the drop come, under 0.3 the bath is above it.
TEST(DropLanding, ASheetThatFloatsCoversTheBath) {
  const auto lands = [](double level, const Vector3& place) {
    Frame frame = after_step({0, 0, 0}, std::vector<Drop>{ball(0.5, place, {0, 0, -3})});
    const Scene on = landing_scene(
        fmt::format("[environment]\ngravity = [0, 0, -9.81]\nbath = {{density = 1500, level = {}}}\n", level));
    const Landed landed = land_drops(frame, on, nullptr);
    EXPECT_EQ(landed.on_sheet + landed.on_solids, 1U);
    return landed.on_sheet == 1;
  };
  EXPECT_TRUE(lands(0.15, {4.1, 4.2, 0.55}));
  EXPECT_FALSE(lands(0.3, {4.1, 4.2, 0.55}));
  EXPECT_FALSE(lands(0.15, {20, 4, 0.55}));
}

} // namespace
} // namespace sheet::collide
