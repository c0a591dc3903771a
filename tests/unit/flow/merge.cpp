// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that become one: which, and what becomes of what they carry.
#include "libsheet/flow/merge.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/flow/lift.h"
#include "libsheet/flow/merge_patches.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/triangle_pair.h"
#include "libsheet/sheet/append.h"
#include "libsheet/sheet/contact_spring.h"
#include "tests/unit/remesh/sheets.h"

namespace sheet::flow {
namespace {

using formats::Frame;
using testing::Gt;

constexpr double layer = 0.1, gap = 0.08; // [m]

std::string of_material(const std::string& material) {
  return "[sheet]\nshape = \"sphere\"\nradius = 10\nedge_length = 1\nthickness = 0.1\n[material]\nviscosity = "
         "1\ndensity = 3\n" +
         material;
}

Scene merging_scene(const std::string& more = "", const std::string& on = "all") {
  return parse_scene(of_material("[environment]\ngravity = [0, 0, -9.81]\n[contact]\nself = true\n[merge]\n"
                                 "after = 0.5\non = \"" +
                                 on + "\"\n" + more),
                     "scene");
}

void shift(Frame& frame, const Vector3& by) {
  for (Vector3& x : positions(frame))
    x += by;
}

// Each vertex of the upper sheet over the triangle of the lower one below it, where there is one.
void touch_each_other(Frame& frame, std::size_t lower_vertices, double since) {
  std::vector<ContactSpring> springs;
  const auto x = positions(std::as_const(frame));
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    for (const Corners& c : triangles(std::as_const(frame))) {
      if ((v < lower_vertices) == (c[0] < lower_vertices))
        continue;
      const auto place = [&](std::uint32_t i) { return Vector3(x[i].x(), x[i].y(), 0); };
      const Vector3 a = place(c[0]), b = place(c[1]) - a, d = place(c[2]) - a, p = place(v) - a;
      const double area = b.cross(d).z(), s = p.cross(d).z() / area, t = b.cross(p).z() / area;
      if (s < -1e-9 || t < -1e-9 || s + t > 1 + 1e-9)
        continue;
      ContactSpring spring;
      spring.vertices = {v, c[0], c[1], c[2]};
      spring.weights = {1, s + t - 1, -s, -t};
      spring.normal = v < lower_vertices ? Vector3(-Vector3::UnitZ()) : Vector3(Vector3::UnitZ());
      spring.anchor = spring.offset(x);
      spring.rest = spring.normal.dot(spring.anchor);
      spring.stiffness = {2, 1};
      spring.since = since;
      springs.push_back(spring);
      break;
    }
  write_springs(frame, springs);
}

// A sheet of 12 x 12 cells on a solid, and one of `columns` x `columns` above it, which begins at `at`; both move.
Frame stack(std::uint32_t columns = 8, const Vector3& at = Vector3(0.13, 0.21, gap), double since = 0) {
  Frame frame = test::grid(12, 12, 0.1, layer);
  const std::size_t lower = frame.vertices;
  Frame upper = test::grid(columns, columns, 0.1, layer / 2);
  shift(upper, at);
  append(upper, frame);
  std::vector<std::int32_t> touch(frame.vertices, no_solid);
  std::fill_n(touch.begin(), lower, 0);
  put_touched_solids(frame, touch, 1);
  const auto u = velocities(frame);
  for (std::size_t v = 0; v < frame.vertices; ++v)
    u[v] = Vector3(std::sin(static_cast<double>(v)), std::cos(3.0 * static_cast<double>(v)), v < lower ? 0 : -0.5);
  const auto put = [&](std::string_view name, formats::Place place, formats::Transfer rule) {
    formats::Array& array =
        frame.put(formats::make_array(name, place, formats::Type::float64, 1, "1", rule, frame.rows_at(place)));
    for (std::size_t i = 0; i < array.rows; ++i)
      array.values<double>()[i] = 1 + static_cast<double>(i % 7);
  };
  put("amount", formats::Place::vertex, formats::Transfer::conserve);
  put("dye", formats::Place::triangle, formats::Transfer::conserve);
  put("warmth", formats::Place::vertex, formats::Transfer::interpolate);
  frame.time = 1;
  touch_each_other(frame, lower, since);
  return frame;
}

// Σ over the corners of all triangles of a third of volume times position.
Vector3 moment(const Frame& frame) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t t = 0; t < frame.triangles; ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      sum += volumes(frame)[t] / 3 * positions(frame)[v];
  return sum;
}

double heat(const Frame& frame) {
  double sum = 0;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      sum += volumes(frame)[t] / 3 * frame.find("warmth")->values<double>()[v];
  return sum;
}

double energy(const Frame& frame, double density) {
  double sum = 0;
  for (std::size_t t = 0; t < frame.triangles; ++t)
    for (const std::uint32_t v : triangles(frame)[t])
      sum += density * volumes(frame)[t] / 6 * velocities(frame)[v].squaredNorm();
  return sum;
}

double total_of(const Frame& frame, std::string_view name) { return test::total(frame.find(name)->values<double>()); }

TEST(Merge, KeepsVolumeMomentumAndCentreOfMass) {
  const Frame before = stack();
  Frame frame = before;
  const Merged merged = merge(frame, merging_scene());
  EXPECT_EQ(merged.triangles, 128u); // the whole upper sheet
  EXPECT_EQ(merged.staying, 0u);
  EXPECT_EQ(frame.triangles, 288u);
  EXPECT_EQ(frame.vertices, 169u);
  EXPECT_EQ(test::value_error(frame), "");
  const double volume = test::volume_of(before);
  EXPECT_NEAR(test::volume_of(frame) / volume, 1, 1e-15);
  EXPECT_LT((test::momentum(frame) - test::momentum(before)).norm(), 1e-14 * volume);
  EXPECT_NEAR(moment(frame).z(), moment(before).z(), 1e-14 * volume);
  EXPECT_NEAR(total_of(frame, "amount"), total_of(before, "amount"), 1e-12 * total_of(before, "amount"));
  EXPECT_NEAR(total_of(frame, "dye"), total_of(before, "dye"), 1e-12 * total_of(before, "dye"));
  EXPECT_NEAR(heat(frame), heat(before), 1e-13 * heat(before));
  EXPECT_NEAR(merged.energy, energy(before, 3) - energy(frame, 3), 1e-14);
  EXPECT_GT(merged.energy, 0);
  EXPECT_EQ(frame.find("merge.volume")->values<double>()[0], merged.volume);
  EXPECT_NEAR(merged.volume, 0.64 * layer / 2, 1e-15);
  for (const std::int32_t solid : touched_solids(frame, 1))
    EXPECT_EQ(solid, 0);
  EXPECT_EQ(frame.find("contact_vertex")->rows, 0u);
}

// Inside, where the upper sheet covers all around, a layer of 0.05 at 0.08 above one of 0.1.
TEST(Merge, LiftsTheLowerLayerToTheMiddleOfBoth) {
  Frame frame = stack();
  (void)merge(frame, merging_scene());
  const auto x = positions(std::as_const(frame));
  for (std::size_t v = 0; v < frame.vertices; ++v)
    if (x[v].head<2>().cwiseAbs().maxCoeff() < 0.75 && x[v].head<2>().minCoeff() > 0.35) {
      EXPECT_NEAR(x[v].z(), gap * 0.05 / 0.15, 1e-12);
    }
}

TEST(Merge, NothingThatIsYoungOrAloneOrOff) {
  const auto merges = [](Frame frame, const Scene& scene) { return merge(frame, scene).triangles; };
  EXPECT_EQ(merges(stack(8, Vector3(0.13, 0.21, gap), 0.6), merging_scene()), 0u); // touches for 0.4 s
  EXPECT_EQ(merges(stack(8, Vector3(0.13, 0.21, 0.12), 0), merging_scene()), 0u);  // 1.6 thicknesses away
  EXPECT_EQ(merges(stack(1, Vector3(0.13, 0.21, gap), 0), merging_scene()), 0u);   // a crumb
  EXPECT_THAT(merges(stack(8, Vector3(0.13, 0.21, gap), 0.5), merging_scene()), Gt(0u));
  EXPECT_THAT(merges(stack(), merging_scene("", "solids")), Gt(0u));
  Frame in_air = stack();
  in_air.erase("touch");
  EXPECT_EQ(merges(in_air, merging_scene("", "solids")), 0u);
  EXPECT_THAT(merges(in_air, merging_scene()), Gt(0u)); // the piece with less volume goes
  Frame held = stack();
  for (std::uint64_t& bits : put_masks(held, "hold"))
    bits = 1;
  EXPECT_EQ(merges(held, merging_scene()), 0u);
  Frame nothing = held;
  (void)merge(nothing, merging_scene());
  EXPECT_EQ(nothing.arrays.size(), held.arrays.size());
}

// By default as soon as tension may have drawn both together, by its law, and faster where it is strained anyway.
TEST(Merge, WhatThinsIsSoonDrawnTogether) {
  const auto merges = [](const std::string& material, double since, bool moves = true) {
    Frame frame = stack(8, Vector3(0.13, 0.21, gap), since);
    if (!moves)
      std::ranges::fill(velocities(frame), Vector3::Zero());
    return merge(frame, parse_scene(of_material(material) + "[contact]\nself = true\n[merge]\non = \"all\"\n", "scene"))
               .triangles > 0;
  };
  const std::string thins = "law = \"power\"\nflow_index = 0.5\n";
  EXPECT_FALSE(merges("surface_tension = 0.5\n", 0.95));                 // mu h/gamma = 0.1 s
  EXPECT_TRUE(merges(thins + "surface_tension = 0.5\n", 0.95));          // 0.1 Pa s at gamma/h: 0.01 s
  EXPECT_TRUE(merges(thins + "surface_tension = 0.005\n", -19));         // about 0.2 Pa s as it flows
  EXPECT_FALSE(merges(thins + "surface_tension = 0.005\n", -19, false)); // 10 Pa s at gamma/h: 100 s
}

TEST(Merge, WeldsAreAsStiffAsTheirLiquidAtTheRateOfTheirMotion) {
  const auto stiffness = [](const std::string& material) {
    Frame frame = stack(8, Vector3(0.75, 0.21, gap));
    merge(frame,
          parse_scene(of_material(material) + "[model]\ninertia = false\n[environment]\ngravity = [0, 0, -9.81]\n"
                                              "[contact]\nself = true\n[merge]\nafter = 0.5\non = \"all\"\n",
                      "scene"));
    for (const ContactSpring& s : read_springs(frame))
      if (s.welded())
        return s.stiffness[0];
    return 0.0;
  };
  const double newtonian = stiffness(""), time = newtonian / (50 * 9.81); // k = mu h/(2 T), T = 0.1 sqrt(h/g)
  EXPECT_NEAR(stiffness("law = \"power\"\nflow_index = 0.5\n") / newtonian, std::sqrt(time), 1e-9);
}

// The upper sheet juts out over the lower one's edge: what lies on it goes, the rest stays, with its border welded.
TEST(Merge, WeldsTheBorderOfWhatStays) {
  const Frame before = stack(8, Vector3(0.75, 0.21, gap));
  Frame frame = before;
  const Merged merged = merge(frame, merging_scene());
  EXPECT_THAT(merged.triangles, Gt(30u));
  EXPECT_LT(merged.triangles, 72u); // no more than lie over the lower sheet
  EXPECT_EQ(merged.welds, 9u);
  EXPECT_NEAR(test::volume_of(frame) / test::volume_of(before), 1, 1e-15);
  EXPECT_LT((test::momentum(frame) - test::momentum(before)).norm(), 1e-14);
  EXPECT_NEAR(moment(frame).z(), moment(before).z(), 1e-14);
  std::size_t welds = 0;
  const auto x = positions(std::as_const(frame));
  for (const ContactSpring& s : read_springs(frame))
    if (s.welded()) {
      ++welds;
      EXPECT_NEAR(s.gap(s.offset(x)), 0, 1e-15);
      EXPECT_LT(s.slide(s.offset(x)).norm(), 1e-15);
      EXPECT_NEAR(s.stiffness[0], s.stiffness[1], 0);
      EXPECT_GT(s.stiffness[0], 0.05 / (0.2 * std::sqrt(0.05 / 9.81))); // μ h/(2 T) with h = d at least 0.05
    }
  EXPECT_EQ(welds, 9u);
  const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  for (std::uint32_t s = 0; s < mesh.triangles.size(); ++s)
    for (std::uint32_t t = 0; t < s; ++t)
      EXPECT_FALSE(triangles_intersect(x, mesh.triangles[s], mesh.triangles[t]));
  const Merged again = merge(frame, merging_scene()); // what is left is not wholly on the lower one
  EXPECT_EQ(again.triangles, 0u);
}

// Three sheets on each other, of 12, 8 and 6 cells, the lowest on a solid or not.
Frame pile(bool on_solid) {
  Frame frame = stack();
  const std::size_t lower = 169;
  Frame third = test::grid(6, 6, 0.1, layer / 2);
  shift(third, Vector3(0.22, 0.28, gap + 0.06));
  const std::size_t two = frame.vertices;
  std::vector<ContactSpring> springs = read_springs(frame);
  append(third, frame);
  Frame upper = frame; // springs between the second and the third
  touch_each_other(upper, two, 0);
  for (const ContactSpring& s : read_springs(upper))
    if (std::ranges::all_of(s.vertices, [&](std::uint32_t v) { return v >= lower; }))
      springs.push_back(s);
  std::vector<std::int32_t> touch(frame.vertices, no_solid);
  if (on_solid)
    std::fill_n(touch.begin(), lower, 0);
  put_touched_solids(frame, touch, 1);
  write_springs(frame, springs);
  return frame;
}

// The second goes at once, the third when it has lain on the first.
TEST(Merge, PilesGoFromBelow) {
  Frame frame = pile(true);
  const Merged merged = merge(frame, merging_scene());
  EXPECT_EQ(merged.triangles, 128u);
  EXPECT_EQ(frame.triangles, 288u + 72u);
}

// A part of the second has touched the first for too short a time, as far as y = 0.6 m. The third, which lies on both
// parts, does not go into the one that stays, as that piece goes.
TEST(Merge, OfAPileEachPieceGoesOrTakes) {
  Frame frame = pile(true);
  const auto x = positions(std::as_const(frame));
  std::vector<ContactSpring> springs = read_springs(frame);
  for (ContactSpring& s : springs)
    if (std::ranges::any_of(s.vertices, [](std::uint32_t v) { return v < 169; }) && x[s.vertices[0]].y() < 0.6)
      s.since = 0.9;
  write_springs(frame, springs);
  const MergePatches patches =
      find_patches(frame, connect(frame.vertices, triangles(std::as_const(frame))), merging_scene());
  const auto taken_of = [&](std::size_t first, std::size_t last) {
    return std::count(patches.taken.begin() + static_cast<std::ptrdiff_t>(first),
                      patches.taken.begin() + static_cast<std::ptrdiff_t>(last), true);
  };
  EXPECT_GT(taken_of(288, 416), 30);
  EXPECT_EQ(taken_of(416, 488), 0);
}

// Of two sheets of one volume but for rounding, on no solid, the upper one goes.
TEST(Merge, RoundingOfVolumesDoesNotDecide) {
  for (const double times : {1 - 1e-15, 1 + 1e-15}) {
    Frame frame = stack(12, Vector3(0, 0, gap));
    put_touched_solids(frame, std::vector<std::int32_t>(frame.vertices, no_solid), 1);
    const auto volume = volumes(frame);
    for (std::size_t t = 0; t < 288; ++t)
      volume[t + 288] = volume[t] * times;
    const MergePatches patches =
        find_patches(frame, connect(frame.vertices, triangles(std::as_const(frame))), merging_scene());
    EXPECT_EQ(std::count(patches.taken.begin(), patches.taken.begin() + 288, true), 0) << times;
    EXPECT_EQ(std::count(patches.taken.begin() + 288, patches.taken.end(), true), 288) << times;
  }
}

// A strip that is folded over: the upper leg goes into the lower one, and the bend is its rim.
TEST(Merge, ClosesAFold) {
  Frame frame = test::grid(4, 16, 0.1, layer);
  for (Vector3& x : positions(frame))
    if (x.y() > 0.8)
      x = Vector3(x.x(), 1.6 - x.y(), std::min(gap, x.y() - 0.8));
  frame.time = 1;
  std::vector<ContactSpring> springs;
  const auto x = positions(std::as_const(frame));
  for (std::uint32_t v = 9 * 5; v < frame.vertices; ++v) // the bend has no contact
    for (const Corners& c : triangles(std::as_const(frame)))
      if (std::ranges::all_of(c, [&](std::uint32_t i) { return i < 8 * 5; })) {
        const ClosestPoints over = closest_vertex_triangle({x[v], x[c[0]], x[c[1]], x[c[2]]});
        if (over.offset.norm() > gap + 1e-9)
          continue;
        springs.push_back({.vertices = {v, c[0], c[1], c[2]}, .weights = over.weights, .rest = gap, .since = 0});
        break;
      }
  write_springs(frame, springs);
  const double volume = test::volume_of(frame);
  const Merged merged = merge(frame, merging_scene());
  EXPECT_EQ(merged.triangles, 64u);
  EXPECT_EQ(merged.welds, 0u);
  EXPECT_EQ(frame.triangles, 64u);
  EXPECT_NEAR(test::volume_of(frame), volume, 1e-15 * volume);
  EXPECT_EQ(test::value_error(frame), "");
}

// A triangle just above the middle of a sheet's, and vertices below it that would go through.
TEST(Lift, StopsWhereThereIsNoRoom) {
  Frame frame = test::grid(3, 3, 1, 0.1);
  const std::vector<Vector3> more = {{1.3, 1.4, 0.05}, {1.6, 1.4, 0.05}, {1.4, 1.7, 0.05}};
  append(make_frame(more, std::vector<Corners>{{0, 1, 2}}, std::vector<double>{1}), frame);
  const Connectivity mesh = connect(frame.vertices, triangles(std::as_const(frame)));
  const auto x = positions(std::as_const(frame));
  std::vector<Vector3> ways(frame.vertices, Vector3::Zero());
  for (std::size_t v = 0; v < 16; ++v)
    ways[v] = Vector3(0, 0, v == 5 ? 0.2 : 0.01);
  const std::vector<bool> none(mesh.triangles.size(), false);
  EXPECT_GE(keep_clear(mesh, none, x, {}, ways), 1u);
  EXPECT_TRUE(ways[5].isZero(0));
  EXPECT_EQ(ways[15].z(), 0.01);
  std::vector<bool> taken = none;
  taken.back() = true;
  ways[5] = Vector3(0, 0, 0.2);
  EXPECT_EQ(keep_clear(mesh, taken, x, {}, ways), 0u);
}

} // namespace
} // namespace sheet::flow
