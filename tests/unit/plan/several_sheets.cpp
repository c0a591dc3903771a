// SPDX-License-Identifier: GPL-3.0-or-later
// What is planned of a scene by what its sheets are counts each of them.
#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/blow_up.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/forecast.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/plan/symmetry.h"
#include "libsheet/scene/read.h"
#include "tests/unit/scene/scenes.h"

namespace sheet {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

std::string sphere(double radius, double thickness, std::string_view more = "") {
  return fmt::format("[[sheet]]\nshape = \"sphere\"\nradius = {}\nedge_length = {}\nthickness = {}\ncenter = [{}, 0, "
                     "0]\n{}",
                     radius, radius / 3, thickness, 10 * radius, more);
}

Scene with_liquid(const std::string& text) { return scene::parse_scene(text + scene::liquid, "s"); }

Forecast forecast_of(const Scene& scene) {
  return forecast(scene, first_frame(scene), {.until = 1, .fps = 24, .stages = ""}, 0.01);
}

TEST(SeveralSheets, TheFirstThatIsBlownUpEndsTheRun) {
  const std::string pressure = "[environment]\npressure = {law = \"constant\", value = 100}\n";
  const double thick = *blow_up_time(with_liquid(sphere(0.1, 0.01) + pressure));
  EXPECT_DOUBLE_EQ(*blow_up_time(with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001) + pressure)), thick / 20);
  EXPECT_DOUBLE_EQ(*blow_up_time(with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001, "enters = 0.5\n") + pressure)),
                   std::min(thick, thick / 20 + 0.5));
}

TEST(SeveralSheets, NoiseGoesByEachOnesThickness) {
  const Scene scene = with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001));
  EXPECT_THAT(small_noise(scene, measured_sheets(scene, first_frame(scene))),
              ElementsAre(StartsWith("sheet.0.perturbation={amplitude = \"1 um\""),
                          StartsWith("sheet.1.perturbation={amplitude = \"0.1 um\"")));
}

TEST(SeveralSheets, RunsLastAsLongAsTheSlowestOne) {
  const std::string gravity = "[environment]\ngravity = [0, 0, -9.81]\n";
  const auto until = [](const Scene& scene) { return proposed_ring(scene, first_frame(scene), {}).until; };
  const Scene small = with_liquid(sphere(0.01, 1e-4) + gravity), large = with_liquid(sphere(1, 0.01) + gravity);
  const Scene both = with_liquid(sphere(0.01, 1e-4) + sphere(1, 0.01) + gravity);
  EXPECT_NE(until(small), until(large));
  EXPECT_DOUBLE_EQ(until(both), std::max(until(small), until(large)));
}

TEST(SeveralSheets, ForecastsCountThoseThatEnter) {
  const double one = forecast_of(with_liquid(sphere(0.1, 0.01))).vertices;
  EXPECT_NEAR(forecast_of(with_liquid(sphere(0.1, 0.01) + sphere(0.1, 0.01, "enters = 0.5\n"))).vertices, 1.5 * one,
              1e-9 * one);
}

} // namespace
} // namespace sheet
