// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of trouble is found in a frame that has it, and in none that has not; told with place, time and remedy.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/health/look.h"
#include "libsheet/health/record.h"
#include "libsheet/health/report.h"
#include "libsheet/health/teller.h"
#include "libsheet/scene/read.h"
#include "libsheet/sheet/account.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::health {
namespace {

using formats::Frame;
using testing::HasSubstr;

constexpr double start_thickness = 0.01; // [m]

Scene scene_with(const std::string& more = "") {
  return parse_scene("[sheet]\nshape = \"rectangle\"\nsize = [1, 1]\nedge_length = 0.25\nthickness = 0.01\n"
                     "[material]\nviscosity = 100\ndensity = 1000\n[environment]\ngravity = [0, -9.81, 0]\n" +
                         more,
                     "test", {});
}

// A sheet of 4 x 4 squares over the unit square, each two triangles; `height` of a vertex over its place.
template <class Height> Frame grid(Height&& height, double thickness = start_thickness) {
  constexpr std::uint32_t n = 4;
  std::vector<Vector3> x;
  std::vector<Corners> t;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      x.emplace_back(i / 4.0, height(i, j), j / 4.0);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i;
      t.push_back({a, a + n + 1, a + 1});
      t.push_back({a + 1, a + n + 1, a + n + 2});
    }
  Frame frame = make_frame(x, t, std::vector<double>(t.size(), thickness / 32));
  frame.time = 0.5;
  frame.step = 100;
  return frame;
}

Frame flat() {
  return grid([](auto, auto) { return 0.0; });
}

Observation only(const std::vector<Observation>& seen) {
  EXPECT_EQ(seen.size(), 1U);
  return seen.empty() ? Observation{} : seen.front();
}

// What the run of a frame that has seen this so often is told.
std::string told(const Observation& seen, int times) {
  Frame frame = flat();
  for (int i = 0; i < times; ++i)
    note(frame, seen);
  return report(frame);
}

TEST(Health, FindsNothingInAGoodSheet) {
  const Scene scene = scene_with();
  EXPECT_TRUE(look(flat(), &scene).empty());
  EXPECT_TRUE(look(flat(), nullptr).empty());
  EXPECT_EQ(report(flat()), "");
}

TEST(Health, FindsThinPlacesByTheStart) {
  const Scene scene = scene_with();
  Frame frame = flat();
  volumes(frame)[3] *= 2e-3;
  volumes(frame)[4] *= 5e-3;
  const Observation seen = only(look(frame, &scene));
  EXPECT_EQ(seen.trouble, Trouble::thin);
  EXPECT_NEAR(seen.value, 2e-3, 1e-15);
  EXPECT_NEAR(seen.share, 2.0 / 32, 1e-12);
  const auto x = positions(std::as_const(frame));
  const Corners c = triangles(frame)[3];
  EXPECT_NEAR((*seen.place - (x[c[0]] + x[c[1]] + x[c[2]]) / 3).norm(), 0, 1e-12);
  const std::string text = told(seen, 1);
  EXPECT_THAT(text, HasSubstr("thin: the sheet is down to 0.002 of its thickness at the start, at (0.4"));
  EXPECT_THAT(text, HasSubstr("t = 0.5 s; on up to 6.2 % of the area"));
  EXPECT_THAT(text, HasSubstr("remedy: "));
  EXPECT_THAT(text, HasSubstr("[tear] below"));
  EXPECT_THAT(text, Not(HasSubstr("serious")));
  EXPECT_THAT(told({.trouble = Trouble::thin, .value = 9e-5}, 1), HasSubstr("serious: thin"));
  // a hundredth is not yet thin, and with [tear] the scene says itself what becomes of it
  volumes(frame)[3] = volumes(frame)[4] = 1.01e-2 * start_thickness / 32;
  EXPECT_TRUE(look(frame, &scene).empty());
  volumes(frame)[3] *= 1e-3;
  const Scene tearing = scene_with("[tear]\nbelow = 0.001\n"), parting = scene_with("[tear]\nsnap = 0.001\n");
  EXPECT_TRUE(look(frame, &tearing).empty());
  EXPECT_EQ(only(look(frame, &parting)).trouble, Trouble::thin); // only strands part
}

// A strand of one row, 10 mm wide, with two rims and nothing else.
TEST(Health, FindsThreads) {
  const auto strand = [](std::size_t count, double thickness) {
    const double side = 0.01 / std::sqrt(0.75);
    std::vector<Vector3> x;
    std::vector<Corners> t;
    for (std::uint32_t i = 0; i < count + 2; ++i)
      x.emplace_back(i * side / 2, 0, i % 2 == 0 ? 0 : 0.01);
    for (std::uint32_t i = 0; i < count; ++i)
      t.push_back(i % 2 == 0 ? Corners{i, i + 1, i + 2} : Corners{i + 1, i, i + 2});
    return make_frame(x, t, std::vector<double>(count, thickness * 0.01 * side / 2));
  };
  const Scene scene = scene_with(), parting = scene_with("[tear]\nsnap = 0.001\n");
  const Frame thread = strand(20, 0.0125);
  const Observation seen = only(look(thread, &scene));
  EXPECT_EQ(seen.trouble, Trouble::threads);
  EXPECT_NEAR(seen.value, 0.8, 1e-9);
  EXPECT_THAT(told(seen, 3),
              HasSubstr("threads: strands, one triangle wide, are down to 0.8 times as wide as they are thick, at ("));
  EXPECT_THAT(told(seen, 3), HasSubstr("[tear] snap"));
  EXPECT_EQ(told(seen, 2), "");
  EXPECT_TRUE(look(thread, &parting).empty());
  EXPECT_TRUE(look(strand(20, 0.009), &scene).empty());
  EXPECT_TRUE(look(strand(7, 0.0125), &scene).empty());
  EXPECT_THAT(look(grid([](auto, auto) { return 0.0; }, 1), &scene), // thick, but no strand
              testing::Not(testing::Contains(testing::Field(&Observation::trouble, Trouble::threads))));
}

// Triangles of edges of 0.25 m, 1 m thick, of 0.01 m.
TEST(Health, FindsWhatIsCrushed) {
  const Scene scene = scene_with(),
              with_thick = scene_with("[[inflow]]\nregion = \"x_max\"\nvelocity = [-1, 0, 0]\n"
                                      "thickness = 0.3\n"),
              with_plane = scene_with("[[solid]]\nshape = \"plane\"\n");
  Frame frame = flat();
  volumes(frame)[3] = 1.0 / 32;
  const Observation seen = only(look(frame, &scene));
  EXPECT_EQ(seen.trouble, Trouble::crushed);
  EXPECT_NEAR(seen.value, 100, 1e-9);
  EXPECT_TRUE(look(frame, &with_thick).empty()); // 3.3 times what enters
  volumes(frame)[3] = 0.7 / 32;                  // of twice its longest edge, 0.707 m
  EXPECT_TRUE(look(frame, &scene).empty());
  volumes(frame)[3] = 1.0 / 32;
  put_touched_solids(frame, std::vector<std::int32_t>(frame.vertices, 0), 1);
  EXPECT_THAT(look(frame, &with_plane),
              testing::Not(testing::Contains(testing::Field(&Observation::trouble, Trouble::crushed))));
}

TEST(Health, FindsSharpTriangles) {
  const Scene scene = scene_with();
  Frame frame = flat();
  const Corners c = triangles(frame)[8]; // its corner against the middle of the side that lies opposite
  auto x = positions(frame);
  x[c[0]] = 0.5 * (x[c[1]] + x[c[2]]) + 0.02 * (x[c[0]] - 0.5 * (x[c[1]] + x[c[2]]));
  const Observation seen = only(look(frame, nullptr));
  EXPECT_EQ(seen.trouble, Trouble::sharp);
  EXPECT_NEAR(seen.value, std::atan(0.02) * 180 / std::numbers::pi, 1e-9);
  EXPECT_THAT(told(seen, 3), HasSubstr("sharp triangles: triangles have angles down to 1.15 degrees, at ("));
  EXPECT_THAT(told(seen, 3), HasSubstr("sheet-remesh"));
  EXPECT_EQ(told(seen, 2), ""); // a needle that is gone soon
  EXPECT_THAT(told({.trouble = Trouble::sharp, .value = 0.4}, 3), HasSubstr("serious: sharp"));
}

TEST(Health, FindsFoldsThatAreSharperThanEdges) {
  // A zigzag, whose faces meet at 53 degrees: it turns by 127 degrees over each edge; and one of a third of its height.
  const Frame sharp = grid([](auto i, auto) { return 0.5 * (i % 2); });
  const Observation seen = only(look(sharp, nullptr));
  EXPECT_EQ(seen.trouble, Trouble::coarse_fold);
  EXPECT_GT(seen.value, 90);
  EXPECT_GT(seen.share, 0.5);
  EXPECT_TRUE(look(grid([](auto i, auto) { return 0.15 * (i % 2); }), nullptr).empty());
  EXPECT_EQ(told(seen, 2), ""); // what opens again soon
  EXPECT_THAT(told(seen, 3), HasSubstr("serious: edges longer than folds: the sheet turns by up to "));
  EXPECT_THAT(told(seen, 3), HasSubstr("edge_length"));
  Observation small = seen;
  small.share = 0.03;
  EXPECT_THAT(told(small, 3), Not(HasSubstr("serious")));
}

TEST(Health, FindsEdgesThatSpanWhatTheyLieOn) {
  for (const auto& [solid, found] :
       {std::pair{"shape = \"capsule\"\nradius = 0.1\nlength = 2\n", true},
        std::pair{"shape = \"capsule\"\nradius = 0.5\nlength = 2\n", false},
        std::pair{"shape = \"box\"\nsize = [1, 0.1, 1]\n", false}, // a plate
        std::pair{"shape = \"box\"\nsize = [0.1, 0.05, 1]\n", true},
        std::pair{"shape = \"sphere\"\nradius = 0.1\n", true},
        std::pair{"shape = \"cylinder\"\nradius = 1\nheight = 0.1\n", false},
        std::pair{"shape = \"cylinder\"\nradius = 0.1\nheight = 1\n", true}, std::pair{"shape = \"plane\"\n", false}}) {
    const Scene scene = scene_with(std::string("[[solid]]\ncenter = [0, -1, 0]\n") + solid);
    Frame frame = flat();
    std::vector<std::int32_t> touch(frame.vertices, no_solid);
    touch[12] = 0;
    put_touched_solids(frame, touch, 1);
    const auto seen = look(frame, &scene);
    ASSERT_EQ(seen.size(), found ? 1U : 0U) << solid;
    if (!found)
      continue;
    EXPECT_EQ(seen[0].trouble, Trouble::coarse_solid);
    EXPECT_NEAR(seen[0].value, std::sqrt(2.0) / 4 / 0.1, 1e-12);
    EXPECT_NEAR(seen[0].share, 6.0 / 32, 1e-12);
    EXPECT_THAT(told(seen[0], 3), HasSubstr("serious: edges longer than a solid: edges that lie on a solid are up to "
                                            "3.54 times as long as it is wide"));
  }
}

TEST(Health, FindsStepsFarBelowTheScenesTime) {
  const Scene scene = scene_with(); // a metre, at 3.13 m/s
  Frame frame = flat();
  put_number(frame, "step_size", 1e-3);
  EXPECT_TRUE(look(frame, &scene).empty());
  put_number(frame, "step_size", 1e-4);
  const Observation seen = only(look(frame, &scene));
  EXPECT_EQ(seen.trouble, Trouble::short_steps);
  EXPECT_NEAR(seen.value, 1e-4 * std::sqrt(9.81), 1e-12);
  EXPECT_EQ(told(seen, 2), "");
  EXPECT_THAT(told(seen, 3), HasSubstr("short steps: steps are down to 0.000313 of the time in which the scene flows"));
  EXPECT_THAT(told({.trouble = Trouble::short_steps, .value = 1e-6}, 3), HasSubstr("serious: short steps"));
  // steps of what falls faster than that are as long as they need be
  Frame falling = frame;
  std::ranges::fill(velocities(falling), Vector3(0, -31.3, 0));
  EXPECT_TRUE(look(falling, &scene).empty());
  // so are steps of what rests on a bath
  Frame resting = frame;
  std::ranges::fill(velocities(resting), Vector3(0, 1e-7, 0));
  put_number(resting, "step_size", 1e-3);
  Scene afloat = scene_with();
  afloat.environment.bath = BathLiquid{.density = 2 * afloat.material.density};
  EXPECT_TRUE(look(resting, &afloat).empty());
  put_number(resting, "step_size", 1e-4);
  EXPECT_EQ(only(look(resting, &afloat)).trouble, Trouble::short_steps);
  // and of what stands by its yield stress
  Scene standing = scene_with();
  standing.material.law.kind = FlowLawKind::bingham;
  standing.material.law.yield_stress = 1e5;
  put_number(resting, "step_size", 1e-3);
  EXPECT_TRUE(look(resting, &standing).empty());
  put_number(resting, "step_size", 1e-4);
  EXPECT_EQ(only(look(resting, &standing)).trouble, Trouble::short_steps);
  standing.model.inertia = false;
  EXPECT_TRUE(look(resting, &standing).empty());
  // gas may drive it a thousand times as fast as what else the scene says
  Scene blown = scene_with();
  blown.environment.pressure =
      scene::GasPressure{.amount = 1, .value = 0, .ambient = 1e5, .exponent = 1, .leak = 0, .more_volume = 0};
  EXPECT_TRUE(look(frame, &blown).empty());
}

TEST(Health, FindsCrumbs) {
  Frame frame = flat();
  const double whole = start_thickness;
  add_to_account(frame, "tear.volume", "m^3", std::vector{whole / 200});
  EXPECT_TRUE(look(frame, nullptr).empty());
  add_to_account(frame, "tear.volume", "m^3", std::vector{whole / 50});
  const Observation seen = only(look(frame, nullptr));
  EXPECT_EQ(seen.trouble, Trouble::crumbs);
  EXPECT_NEAR(seen.value, 0.025 / 1.025, 1e-12);
  EXPECT_THAT(told(seen, 1), HasSubstr("crumbs: 2.4 % of the volume has been dropped as crumbs and threads"));
  EXPECT_THAT(told({.trouble = Trouble::crumbs, .value = 0.2}, 1), HasSubstr("serious"));
}

TEST(Health, KnowsWhichVolumeIsExplained) {
  const Frame before = flat();
  Frame after = before;
  for (double& v : volumes(after))
    v *= 1.5;
  EXPECT_NEAR(unexplained_volume(before, after), start_thickness / 2, 1e-15);
  add_to_account(after, "emit.volume", "m^3", std::vector{start_thickness});
  add_to_account(after, "outflow.volume", "m^3", std::vector{start_thickness / 4});
  add_to_account(after, "tear.volume", "m^3", std::vector{start_thickness / 4});
  EXPECT_NEAR(unexplained_volume(before, after), 0, 1e-16);
  EXPECT_THAT(told({.trouble = Trouble::volume, .value = 1e-5, .amount = -1e-7}, 2),
              HasSubstr("0.001 % of the volume was won or lost in one step"));
  EXPECT_THAT(told({.trouble = Trouble::volume, .value = 1e-5, .amount = -1e-7}, 2), HasSubstr("-2e-07 m^3 in all"));
  EXPECT_THAT(told({.trouble = Trouble::volume, .value = 0.1}, 1), HasSubstr("serious"));
}

TEST(Health, OfStagesIsToldOnceAndCounted) {
  Frame frame = flat();
  Teller teller;
  testing::internal::CaptureStderr();
  for (int i = 0; i < 3; ++i)
    teller.tell(frame, Trouble::held_back, 2, Vector3(1, 2, 3), "step 7: two vertices stay behind");
  teller.report();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("step 7: two vertices stay behind (told once, then counted)"));
  EXPECT_EQ(said.find("step 7"), said.rfind("step 7"));
  EXPECT_THAT(said, HasSubstr("intersections waited for: 3 times in all"));
  EXPECT_THAT(report(frame), HasSubstr("up to 2 vertices on solids or held stayed behind in a step"));
  EXPECT_THAT(report(frame), HasSubstr("at (1, 2, 3) m, t = 0.5 s"));
  EXPECT_THAT(report(frame), HasSubstr("seen 3 times from t = 0.5 to 0.5 s, 6 vertices in all"));
}

TEST(Health, OfStagesIsSeriousWhereItComesBack) {
  for (const Trouble trouble :
       {Trouble::held_back, Trouble::close_to_solid, Trouble::not_converged, Trouble::edits_due}) {
    const Observation seen{.trouble = trouble, .value = 3, .amount = 3};
    EXPECT_THAT(told(seen, 1), HasSubstr(kind_of(trouble).name));
    EXPECT_THAT(told(seen, 1), Not(HasSubstr("serious"))) << kind_of(trouble).name;
    EXPECT_THAT(told(seen, 20), HasSubstr("serious")) << kind_of(trouble).name; // of 100 steps
  }
  EXPECT_THAT(told({.trouble = Trouble::above_tolerance, .value = 0.05}, 20),
              HasSubstr("steps above the tolerance: the error of a step is up to 0.05 of an edge"));
  EXPECT_THAT(told({.trouble = Trouble::above_tolerance, .value = 0.05}, 20), Not(HasSubstr("serious")));
  EXPECT_THAT(told({.trouble = Trouble::above_tolerance, .value = 0.5}, 20), HasSubstr("serious"));
  EXPECT_EQ(told({.trouble = Trouble::two_solids, .value = 0.1, .amount = 3}, 2), "");
  EXPECT_THAT(told({.trouble = Trouble::two_solids, .value = 0.1, .amount = 3}, 3), Not(HasSubstr("serious")));
  EXPECT_THAT(told({.trouble = Trouble::two_solids, .value = 0.1, .amount = 3}, 20),
              HasSubstr("serious: between two solids: up to 10 % of the vertices"));
}

TEST(Health, RecordKeepsTheWorstAndCounts) {
  Frame frame = flat();
  note(frame, {.trouble = Trouble::sharp, .value = 4, .share = 0.2, .amount = 5, .place = Vector3(1, 0, 0)});
  frame.time = 0.75;
  note(frame, {.trouble = Trouble::sharp, .value = 2, .share = 0.1, .amount = 3, .place = Vector3(2, 0, 0)});
  frame.time = 1;
  note(frame, {.trouble = Trouble::sharp, .value = 3, .share = 0.1, .amount = 1, .place = Vector3(3, 0, 0)});
  note(frame, {.trouble = Trouble::thin, .value = 1e-3});
  const std::vector<Row> all = rows(frame);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].kind, 1);
  EXPECT_FALSE(all[0].place);
  EXPECT_EQ(all[1].kind, 2);
  EXPECT_EQ(all[1].times, 3);
  EXPECT_EQ(all[1].first, 0.5);
  EXPECT_EQ(all[1].last, 1);
  EXPECT_EQ(all[1].worst, 2);
  EXPECT_EQ(all[1].worst_time, 0.75);
  EXPECT_EQ(*all[1].place, Vector3(2, 0, 0));
  EXPECT_EQ(all[1].share, 0.2);
  EXPECT_EQ(all[1].amount, 9);
  EXPECT_EQ(formats::find_value_error(frame), "");
}

TEST(Health, KindsThatAreNotKnownStay) {
  Frame frame = flat();
  formats::Array array = formats::make_standard_array("health", 1);
  array.values<double>()[0] = 99;
  frame.put(std::move(array));
  note(frame, {.trouble = Trouble::sharp, .value = 4});
  EXPECT_EQ(rows(frame).size(), 2U);
  EXPECT_EQ(rows(frame)[1].kind, 99);
  EXPECT_THAT(report(frame), Not(HasSubstr("99")));
}

TEST(Health, EveryKindHasNumberNameLimitsAndRemedy) {
  double number = 0;
  for (const Kind& kind : kinds()) {
    EXPECT_EQ(static_cast<double>(kind.trouble), ++number);
    EXPECT_EQ(find_kind(number), &kind);
    EXPECT_FALSE(kind.name.empty() || kind.remedy.empty());
    EXPECT_NE(kind.what.find("{}"), std::string_view::npos);
    EXPECT_TRUE(kind.least ? kind.serious.worst <= kind.noted.worst : kind.serious.worst >= kind.noted.worst);
  }
}

} // namespace
} // namespace sheet::health
