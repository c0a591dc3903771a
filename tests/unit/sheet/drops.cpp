// SPDX-License-Identifier: GPL-3.0-or-later
// Drops in a frame, and as small pieces of sheet.
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "libsheet/sheet/drop_shells.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {
namespace {

using formats::Frame;

Frame triangle_alone() {
  const std::vector<Vector3> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Corners> t{{0, 1, 2}};
  return make_frame(x, t, std::vector<double>{1e-3});
}

const std::vector<Drop> two{
    {.position = {1, 2, 3}, .velocity = {0, -1, 0}, .volume = 1e-6, .touch = 2},
    {.position = {4, 5, 6}, .velocity = {7, 8, 9}, .volume = 2e-6, .liquid = 1, .temperature = 300}};

TEST(Drops, AreRowsOfTheFrame) {
  Frame frame = triangle_alone();
  EXPECT_FALSE(knows_drops(frame));
  write_drops(frame, {});
  EXPECT_TRUE(knows_drops(frame));
  EXPECT_TRUE(read_drops(frame).empty());
  frame.put(formats::make_standard_array("liquid", 1));
  put_temperatures(std::vector<double>{290}, frame);
  write_drops(frame, two);
  const std::vector<Drop> read = read_drops(frame);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].position, two[0].position);
  EXPECT_EQ(read[1].velocity, two[1].velocity);
  EXPECT_EQ(read[0].touch, 2U);
  EXPECT_FALSE(read[0].flies());
  EXPECT_EQ(read[1].liquid, 1U);
  EXPECT_EQ(read[1].temperature, 300);
  EXPECT_EQ(volume_of_drops(frame), 3e-6);
  EXPECT_NEAR(read[0].radius(), std::cbrt(3e-6 / (4 * std::numbers::pi)), 1e-15);
}

TEST(Drops, AsShellsHaveTheirVolume) {
  Frame frame = triangle_alone();
  EXPECT_EQ(with_drop_shells(frame), frame);
  (void)velocities(frame);
  write_drops(frame, two);
  const DropShells how{.partings = 1};
  const Frame shells = with_drop_shells(frame, how);
  EXPECT_EQ(formats::find_form_error(shells), "");
  EXPECT_EQ(formats::find_value_error(shells), "");
  EXPECT_EQ(shells.triangles, 1 + 2 * how.triangles());
  EXPECT_FALSE(knows_drops(shells));
  const auto volume = volumes(shells);
  EXPECT_NEAR(std::accumulate(volume.begin() + 1, volume.end(), 0.0), 3e-6, 1e-20);
  for (std::size_t t = 1; t < shells.triangles; ++t) { // outwards, at 0.69 of the radius
    const Drop& drop = two[t <= how.triangles() ? 0 : 1];
    const Corners& c = triangles(shells)[t];
    const Vector3 a = positions(shells)[c[0]] - drop.position, b = positions(shells)[c[1]] - drop.position,
                  d = positions(shells)[c[2]] - drop.position;
    EXPECT_GT((b - a).cross(d - a).dot(a), 0);
    EXPECT_NEAR(a.norm(), std::cbrt(1.0 / 3) * drop.radius(), 1e-12);
    EXPECT_EQ(velocities(shells)[c[0]], drop.velocity);
  }
}

} // namespace
} // namespace sheet
