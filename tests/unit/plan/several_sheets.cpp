// SPDX-License-Identifier: GPL-3.0-or-later
// What is planned of a scene by what its sheets are counts each of them.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/plan/blow_up.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/forecast.h"
#include "libsheet/plan/proposed_ring.h"
#include "libsheet/plan/sheets_meet.h"
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
  const std::string pressure =
      "[environment]\npressure = {law = \"constant\", value = 100}\n[model]\ninertia = false\n";
  const double thick = *blow_up_time(with_liquid(sphere(0.1, 0.01) + pressure));
  EXPECT_DOUBLE_EQ(*blow_up_time(with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001) + pressure)), thick / 20);
  EXPECT_DOUBLE_EQ(*blow_up_time(with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001, "enters = 0.5\n") + pressure)),
                   std::min(thick, thick / 20 + 0.5));
}

TEST(SeveralSheets, NoiseGoesByEachOnesThickness) {
  const Scene scene = with_liquid(sphere(0.1, 0.01) + sphere(0.2, 0.001));
  const std::vector<scene::Measured> measured = measured_sheets(scene, first_frame(scene));
  EXPECT_THAT(small_noise(scene, std::array<std::size_t, 2>{0, 1}, measured),
              ElementsAre(StartsWith("sheet.0.perturbation={amplitude = \"1e+02 um\""),
                          StartsWith("sheet.1.perturbation={amplitude = \"10 um\"")));
}

// Two ribbons side by side come down each in its own plane; the third one is pushed out of it.
TEST(SeveralSheets, EachStaysInItsOwnPlane) {
  const auto ribbon = [](double x, double aside) {
    return fmt::format("[[sheet]]\nname = \"r{}\"\nshape = \"rectangle\"\nsize = [0.02, 0.01]\nplane = \"xy\"\n"
                       "edge_length = 0.003\nthickness = 0.004\ncenter = [0, 0.08, {}]\nvelocity = [0, -0.3, {}]\n",
                       x, x, aside);
  };
  const std::string all = ribbon(-0.025, 0) + ribbon(0.025, 0) + ribbon(0.1, 0.01);
  const std::string below = "[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\n";
  EXPECT_THAT(sheets_in_their_planes(with_liquid(all + below)), ElementsAre(0, 1));
  // both faces meet the same to a thousandth of the thickness
  const auto over = [&](double center) {
    return sheets_in_their_planes(
        with_liquid(ribbon(0, 0) + "[environment]\ngravity = [0, -9.81, 0]\n" +
                    fmt::format("[[solid]]\nshape = \"sphere\"\nradius = 0.02\ncenter = [0, 0, {}]\n", center)));
  };
  EXPECT_THAT(over(1e-6), ElementsAre(0));
  EXPECT_THAT(over(1e-4), ElementsAre());
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

// Two disks of 160 mm and 20 mm thick on a table: 180 mm in the box around each.
bool meet(double apart, const std::string& more = "") {
  const auto disk_at = [](double x) {
    return fmt::format("[[sheet]]\nshape = \"disk\"\nradius = 0.08\nedge_length = 0.02\nthickness = 0.02\nplane = "
                       "\"xz\"\ncenter = [{}, 0.01, 0]\n",
                       x);
  };
  const Scene scene = with_liquid(disk_at(0) + disk_at(apart) +
                                  "[environment]\ngravity = [0, -9.81, 0]\n[[solid]]\nshape = \"plane\"\n" + more);
  return sheets_may_meet(scene, landings(scene, first_frame(scene)));
}

TEST(SeveralSheets, MeetWhereTheyAreNotFarApart) {
  EXPECT_TRUE(meet(0.2));
  EXPECT_TRUE(meet(0.355));
  EXPECT_FALSE(meet(0.365));
  EXPECT_FALSE(meet(0.5));
  EXPECT_TRUE(meet(0.5, "normal = [0.1, 1, 0]\n"));
  EXPECT_TRUE(meet(0.5, "surface_velocity = [0.1, 0, 0]\n"));
  EXPECT_FALSE(sheets_may_meet(with_liquid(sphere(0.1, 0.01)), {}));
}

} // namespace
} // namespace sheet
