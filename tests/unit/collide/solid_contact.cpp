// SPDX-License-Identifier: GPL-3.0-or-later
// What resolve_solids promises.
#include "libsheet/collide/solid_contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "libsheet/base/error.h"
#include "libsheet/base/parallel.h"
#include "libsheet/collide/touch_distance.h"
#include "libsheet/geometry/longest_edges.h"
#include "tests/unit/solid/solid_support.h"

namespace sheet::collide {
namespace {

using test::FallingSheet;

scene::Solid solid(scene::SolidShape shape, const Vector3& center = Vector3::Zero()) {
  scene::Solid result;
  result.shape = std::move(shape);
  result.center = center;
  return result;
}

solid::Solids solids_of(std::vector<scene::Solid> list) {
  Scene scene;
  scene.solids = std::move(list);
  return solid::Solids(scene);
}

scene::Solid lying_rod(double radius) {
  scene::Solid rod = solid(scene::Capsule{radius, 1});
  rod.rotation = scene::Rotation{Vector3::UnitX(), std::numbers::pi / 2};
  return rod;
}

// 10 cm wide, 2 mm thick, edges of 1 cm, 1 mm above y = 0.
constexpr double thickness_of_sheet = 2e-3, step_length = 1.0 / 24;
FallingSheet falling(double speed, double height = 2e-3, const Vector3& across = Vector3::Zero()) {
  return {0.1, 10, thickness_of_sheet, height, Vector3(0, -speed, 0) + across, step_length};
}

double distance_at_end(const FallingSheet& sheet, const solid::Solids& solids, std::size_t v, std::size_t i = 0) {
  return solids.at(i, sheet.path.end[v], sheet.path.end_time).distance;
}

TEST(SolidContact, NothingToDo) {
  FallingSheet sheet = falling(1), far = falling(1);
  const auto end = sheet.path.end;
  EXPECT_EQ(resolve_solids(sheet.path, solids_of({})).touching, 0U);
  EXPECT_EQ(resolve_solids(far.path, solids_of({solid(scene::Sphere{1}, {0, -5, 0})})).touching, 0U);
  EXPECT_EQ(sheet.path.end, end);
  EXPECT_EQ(far.path.end, end);
  EXPECT_TRUE(unsafe_triangles(far.path, solids_of({solid(scene::Sphere{1}, {0, -5, 0})})).empty());
}

// Films that are drawn out to nothing beside a solid that turns are followed no more exactly than the sheet asks for.
TEST(SolidContact, FilmsOfNoThicknessAskForNoExactness) {
  scene::Solid ball = solid(scene::Sphere{0.05}, {0, -0.055, 0});
  ball.motion = scene::Rotating{.axis = Vector3::UnitY(), .center = Vector3::Zero(), .rate = {{{0, 12.6}}}};
  FallingSheet sheet = falling(0.1), alike = falling(0.1);
  sheet.path.thickness[3] = 3e-10;
  EXPECT_EQ(resolve_solids(sheet.path, solids_of({ball})).caught, resolve_solids(alike.path, solids_of({ball})).caught);
}

// What flows down a wall and meets a floor lies on that from then on; what flows along the floor stays on it. In a
// groove of two slopes as steep, too, it goes on to the second one.
TEST(SolidContact, WhatComesDownAWallLiesOnTheFloor) {
  scene::Solid floor = solid(scene::HalfSpace{{0, 1, 0}}), wall = solid(scene::HalfSpace{{1, 0, 0}}, {-0.051, 0, 0});
  floor.contact = wall.contact = SolidContact::flow;
  const auto touched_after = [&](const Vector3& gravity) {
    FallingSheet sheet = falling(0, thickness_of_sheet / 2, Vector3(-0.1, 0, 0)); // along y = 0, towards the wall
    std::ranges::fill(sheet.path.touch, 0);
    sheet.path.gravity = gravity;
    resolve_solids(sheet.path, solids_of({floor, wall}));
    std::size_t on_wall = 0;
    for (std::size_t v = 0; v < sheet.path.start.size(); ++v)
      if (sheet.path.touch[v] == 1) {
        ++on_wall;
        EXPECT_GT(sheet.path.end[v].x(), -0.051 + thickness_of_sheet / 8);
      }
    return on_wall;
  };
  EXPECT_EQ(touched_after({0, -9.81, 0}), 0U);
  EXPECT_EQ(touched_after({0, 0, 0}), 0U);
  EXPECT_EQ(touched_after({-9.81, 0, 0}), 11U);     // the wall is the floor
  EXPECT_EQ(touched_after({-6.93, -6.94, 0}), 11U); // a groove
}

// The rim of a layer on a floor, so far from another solid: an upright one, as the side of a dish, lets it stand there,
// however near it is, from a hundredth of the thickness on, one that leans puts it off.
TEST(SolidContact, BesideASideARimStaysAsNearAsItIs) {
  const auto nearest = [](double near, const Vector3& normal) {
    FallingSheet sheet = falling(0, thickness_of_sheet / 2);
    std::ranges::fill(sheet.path.touch, 0);
    sheet.path.gravity = {0, -9.81, 0};
    const Vector3 rim(-0.05, thickness_of_sheet / 2, 0);
    scene::Solid floor = solid(scene::HalfSpace{{0, 1, 0}}),
                 side = solid(scene::HalfSpace{normal}, rim - near * normal);
    floor.contact = side.contact = SolidContact::flow;
    const solid::Solids solids = solids_of({floor, side});
    resolve_solids(sheet.path, solids);
    double least = 1;
    for (std::size_t v = 0; v < sheet.path.start.size(); ++v)
      least = std::min(least, distance_at_end(sheet, solids, v, 1));
    return least;
  };
  constexpr double h = thickness_of_sheet;
  EXPECT_NEAR(nearest(h / 5, {1, 0, 0}), h / 5, 1e-9);
  EXPECT_NEAR(nearest(h / 10, {1, 0, 0}), h / 10, 1e-9); // nearer than triangles may come elsewhere
  EXPECT_NEAR(nearest(h / 50, {1, 0, 0}), h / 50, 1e-9);
  EXPECT_NEAR(nearest(0, {1, 0, 0}), h / 100, 1e-9);
  EXPECT_NEAR(nearest(h / 5, {0.8, 0.6, 0}), h / 4, 1e-3 * h);
}

// Between two plates a sheet of 2 mm touches the lower one. Where the upper one leaves it less room than that it
// slides, though it sticks to solids; where it leaves less than half, that is counted.
TEST(SolidContact, WhatIsSqueezedBetweenSolidsSlidesAndIsCounted) {
  for (const double gap : {2.2e-3, 1.9e-3, 0.95e-3}) {
    FallingSheet sheet = falling(1, 1.05e-3);
    scene::Solid upper = solid(scene::SolidBox{{1, 0.1, 1}}, {0, 0.05 + 2.2e-3, 0});
    const SolidReport first = resolve_solids(sheet.path, solids_of({solid(scene::HalfSpace{{0, 1, 0}}), upper}));
    EXPECT_EQ(first.touching, sheet.path.start.size());
    EXPECT_EQ(first.between, 0U);
    upper.center.y() += gap - 2.2e-3;
    upper.motion = scene::Translating{{{{0, {0.05, 0, 0}}}}}; // along itself
    sheet.path.start = sheet.path.end;
    for (Vector3& x : sheet.path.end) // as sheet-step moves what flows
      x += Vector3(1e-3, gap / 2 - 1e-3, 0);
    for (Vector3& v : sheet.path.velocity)
      v = Vector3(0.01, 0, 0);
    std::ranges::fill(sheet.path.fixed, Axes{0});
    const SolidReport then = resolve_solids(sheet.path, solids_of({solid(scene::HalfSpace{{0, 1, 0}}), upper}));
    const bool squeezed = gap < thickness_of_sheet;
    for (const Vector3& v : sheet.path.velocity)
      EXPECT_EQ(v.x(), squeezed ? 0.01 : 0);
    EXPECT_EQ(then.between, gap < 1e-3 ? sheet.path.start.size() : 0U);
    if (then.between == 0)
      continue;
    EXPECT_EQ(std::pair(then.narrowest.first, then.narrowest.second), std::pair(std::size_t{0}, std::size_t{1}));
    EXPECT_NEAR(then.narrowest.gap, gap, 1e-9);
    EXPECT_NEAR(then.narrowest.thickness, thickness_of_sheet, 1e-9);
  }
}

// A sheet flies aslant over a ball: each vertex is caught where its path comes within half the thickness, no earlier,
// and what it would have gone beyond that is told.
TEST(SolidContact, IsCaughtWhereItsPathMeetsTheSurface) {
  const double radius = 0.3, reach = radius + thickness_of_sheet / 2;
  const Vector3 center(0.01, -radius, 0.005);
  FallingSheet sheet = falling(0.04, 2e-3, {0.2, 0, 0.1});
  const std::vector<Vector3> end = sheet.path.end;
  const SolidReport report = resolve_solids(sheet.path, solids_of({solid(scene::Sphere{radius}, center)}));
  EXPECT_GT(report.caught, 4U);
  std::size_t caught = 0;
  for (std::size_t v = 0; v < end.size(); ++v) {
    const Vector3 from = sheet.start[v] - center, way = end[v] - sheet.start[v];
    const double half = from.dot(way), square = way.squaredNorm();
    const double root = half * half - square * (from.squaredNorm() - reach * reach);
    const double s = root >= 0 ? (-half - std::sqrt(root)) / square : 2;
    EXPECT_EQ(sheet.path.touch[v] != no_solid, s >= 0 && s <= 1) << v << " at " << s;
    if (sheet.path.touch[v] == no_solid) {
      EXPECT_TRUE(sheet.path.overshoot[v].isZero(0));
      continue;
    }
    ++caught;
    EXPECT_LT((sheet.path.end[v] - (sheet.start[v] + s * way)).norm(), 1e-5 * thickness_of_sheet) << v;
    EXPECT_EQ(sheet.path.overshoot[v], end[v] - sheet.path.end[v]) << v;
  }
  EXPECT_EQ(caught, report.caught);
}

// Everything falls on the ground: it lies there, half its thickness up, at rest, where it was above.
TEST(SolidContact, OnTheGround) {
  for (const double speed : {0.1, 10.0, 1000.0}) {
    const solid::Solids ground = solids_of({solid(scene::HalfSpace{{0, 1, 0}})});
    FallingSheet sheet = falling(speed);
    EXPECT_FALSE(unsafe_triangles(sheet.path, ground).empty());
    const SolidReport report = resolve_solids(sheet.path, ground);
    EXPECT_EQ(report.touching, sheet.start.size());
    EXPECT_EQ(report.caught, sheet.start.size());
    EXPECT_EQ(report.pushed, 0U);
    for (std::size_t v = 0; v < sheet.start.size(); ++v) {
      EXPECT_NEAR(sheet.path.end[v].y(), thickness_of_sheet / 2, 1e-12);
      EXPECT_NEAR(sheet.path.end[v].x(), sheet.start[v].x(), 1e-12);
      EXPECT_EQ(sheet.path.velocity[v], Vector3(0, 0, 0));
      EXPECT_EQ(sheet.path.touch[v], 0);
      EXPECT_EQ(sheet.path.fixed[v], all_axes);
    }
    EXPECT_TRUE(unsafe_triangles(sheet.path, ground).empty());
  }
}

// What flows keeps its way and its speed along the ground, and loses those across it.
TEST(SolidContact, FlowsAlongTheGround) {
  const Vector3 across(0.3, 0, -0.2);
  for (const auto contact : {SolidContact::flow, SolidContact::slip}) {
    scene::Solid plane = solid(scene::HalfSpace{{0, 1, 0}});
    plane.contact = contact;
    plane.surface_velocity = {7, 0, 0}; // is sheet-step's business
    const solid::Solids ground = solids_of({plane});
    FallingSheet sheet = falling(10, 2e-3, across);
    const auto asked = sheet.path.end;
    EXPECT_EQ(resolve_solids(sheet.path, ground).touching, sheet.start.size());
    for (std::size_t v = 0; v < sheet.start.size(); ++v) {
      EXPECT_NEAR(sheet.path.end[v].y(), thickness_of_sheet / 2, 1e-12);
      EXPECT_NEAR(sheet.path.end[v].x(), asked[v].x(), 1e-12);
      EXPECT_NEAR(sheet.path.end[v].z(), asked[v].z(), 1e-12);
      EXPECT_EQ(sheet.path.velocity[v], across);
      EXPECT_EQ(sheet.path.touch[v], 0);
    }
    // In the next step it goes on so, at the distance that sheet-step gives it.
    FallingSheet next = falling(0, thickness_of_sheet / 2, across);
    next.path.touch = sheet.path.touch;
    for (Vector3& x : next.path.end)
      x.y() = 0.3 * thickness_of_sheet;
    EXPECT_EQ(resolve_solids(next.path, ground).caught, 0U);
    for (std::size_t v = 0; v < next.start.size(); ++v) {
      EXPECT_NEAR(next.path.end[v].y(), 0.3 * thickness_of_sheet, 1e-12);
      EXPECT_NEAR(next.path.end[v].x(), next.start[v].x() + step_length * across.x(), 1e-12);
      EXPECT_EQ(next.path.velocity[v], across);
    }
  }
}

// Every shape, every speed: the guaranteed clearance is kept all along the way, and nothing is left unresolved.
TEST(SolidContact, NothingGetsThrough) {
  std::vector<std::pair<const char*, scene::Solid>> targets;
  targets.emplace_back("sphere", solid(scene::Sphere{0.03}, {0, -0.03, 0}));
  targets.emplace_back("rod", lying_rod(1e-4));
  targets.emplace_back("pin", solid(scene::Capsule{1e-4, 0.1}, {1e-3, -0.0501, 2e-3}));
  scene::Solid corner = solid(scene::SolidBox{{0.02, 0.02, 0.02}}, {0, -0.01 * std::sqrt(3.0), 0});
  corner.rotation = scene::Rotation{Vector3(1, 0, -1), std::acos(1 / std::sqrt(3.0))};
  targets.emplace_back("corner", corner);
  for (std::size_t k = 0; k < 4; ++k) {
    targets.push_back(targets[k]);
    targets.back().second.contact = SolidContact::flow;
  }
  for (const auto& [name, target] : targets)
    for (const double speed : {1.0, 10.0, 100.0}) {
      const solid::Solids solids = solids_of({target});
      FallingSheet sheet = falling(speed);
      const SolidReport report = resolve_solids(sheet.path, solids);
      EXPECT_EQ(report.unresolved, 0U) << name << speed;
      EXPECT_EQ(report.started_across, 0U) << name << speed;
      EXPECT_GE(test::least_distance(sheet.path, solids, 0, 1e-4, 10), thickness_of_sheet / 8 - 1e-9) << name << speed;
      if (target.contact == SolidContact::stick) { // what slides on may leave the solid behind
        EXPECT_LT(test::least_distance(sheet.path, solids, 0, 1e-4, 10), thickness_of_sheet) << name << speed;
      }
      EXPECT_TRUE(unsafe_triangles(sheet.path, solids).empty()) << name << speed;
      for (std::size_t v = 0; v < sheet.start.size(); ++v)
        if (sheet.path.touch[v] != no_solid && report.pushed == 0) {
          EXPECT_NEAR(distance_at_end(sheet, solids, v), thickness_of_sheet / 2, 1e-9) << name << speed;
        }
    }
}

// A mesh is as sharp as it is, however coarse the field: a needle whose tip no voxel sees.
TEST(SolidContact, Needle) {
  const auto shape = make_distance(test::needle(1e-4, 0.05, 6), 5e-3);
  EXPECT_NEAR(shape->nearest({0, 0.06, 0}).distance, 0.01, 1e-12);
  FallingSheet sheet = falling(50, 0.052);
  solid::MovingTriangle over{};
  for (const Corners& c : sheet.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      over.start[i] = sheet.start[c[i]];
      over.end[i] = sheet.path.end[c[i]];
    }
    const solid::Triangle3& t = over.start; // the one right above the tip
    const auto side = [](const Vector3& a, const Vector3& b) { return a.z() * b.x() - a.x() * b.z() > 0; };
    if (side(t[0], t[1]) && side(t[1], t[2]) && side(t[2], t[0]))
      break;
  }
  const auto hit = shape->first_hit(over, 2e-4, 1e-4);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->s * 50 * step_length, 0.002, 4e-4);
}

TEST(SolidContact, SticksToAMovingBelt) {
  scene::Solid belt = solid(scene::HalfSpace{{0, 1, 0}});
  belt.surface_velocity = {0.4, 0, 0};
  const solid::Solids solids = solids_of({belt});
  FallingSheet sheet = falling(0.048); // touches after half of the step
  resolve_solids(sheet.path, solids);
  for (std::size_t v = 0; v < sheet.start.size(); ++v) {
    EXPECT_NEAR(sheet.path.end[v].x() - sheet.start[v].x(), 0.4 * step_length / 2, 0.05 * 0.4 * step_length);
    EXPECT_EQ(sheet.path.velocity[v], Vector3(0.4, 0, 0));
  }
}

TEST(SolidContact, IsCarriedByAMovingSolid) {
  scene::Solid plate = solid(scene::SolidBox{{1, 0.2, 1}}, {0, -0.1, 0});
  plate.motion = scene::Translating{{{{0, {0, 0.5, 0.25}}}}};
  const solid::Solids solids = solids_of({plate});
  FallingSheet sheet = falling(0, thickness_of_sheet / 2); // lies on it
  for (int step = 0; step < 5; ++step) {
    resolve_solids(sheet.path, solids);
    for (std::size_t v = 0; v < sheet.start.size(); ++v) {
      EXPECT_NEAR(distance_at_end(sheet, solids, v), thickness_of_sheet / 2, 1e-12);
      EXPECT_LT((sheet.path.velocity[v] - Vector3(0, 0.5, 0.25)).norm(), 1e-15);
      EXPECT_LT((sheet.path.end[v] - sheet.start[v] - step_length * Vector3(0, 0.5, 0.25)).norm(), 1e-12);
    }
    sheet.go_on();
  }
}

// A bar turns two thirds round in one step and meets the sheet, which stands still, in the course of it.
TEST(SolidContact, MetByATurningBar) {
  scene::Solid bar = solid(scene::Capsule{2e-3, 0.4}, {0, -0.02, 0});
  bar.motion = scene::Rotating{Vector3::UnitX(), {0, -0.02, 0}, {{{0, 100}}}};
  bar.rotation = scene::Rotation{Vector3::UnitX(), 1.8}; // on its way to the sheet from below
  const solid::Solids solids = solids_of({bar});
  FallingSheet sheet = falling(0, 0.1);
  EXPECT_FALSE(unsafe_triangles(sheet.path, solids).empty());
  const SolidReport report = resolve_solids(sheet.path, solids);
  EXPECT_GT(report.caught, 0U);
  EXPECT_EQ(report.unresolved, 0U);
  EXPECT_TRUE(unsafe_triangles(sheet.path, solids).empty());
  for (std::size_t v = 0; v < sheet.start.size(); ++v)
    if (sheet.path.touch[v] != no_solid) {
      const Vector3 arm = sheet.path.end[v] - Vector3(0, -0.02, 0);
      EXPECT_LT((sheet.path.velocity[v] - 100 * Vector3::UnitX().cross(arm)).norm(), 1e-9);
    }
}

TEST(SolidContact, WhatLeavesIsLetGo) {
  const solid::Solids ground = solids_of({solid(scene::HalfSpace{{0, 1, 0}})});
  FallingSheet sheet = falling(-0.01, thickness_of_sheet / 2);
  EXPECT_EQ(resolve_solids(sheet.path, ground).touching, 0U);
  FallingSheet stuck = falling(-0.01, thickness_of_sheet / 2);
  stuck.path.touch.assign(stuck.start.size(), 0);
  EXPECT_EQ(resolve_solids(stuck.path, ground).touching, stuck.start.size());
  EXPECT_NEAR(stuck.path.end[0].y(), thickness_of_sheet / 2, 1e-12);
}

// The middle of an edge that two triangles share falls on a small ball. Both have the same hit, and the point comes to
// rest once: at half of half the thickness from the ball, however short the step.
TEST(SolidContact, WhatTwoTrianglesShareIsPushedOnce) {
  for (const double length : {step_length, step_length / 10, step_length / 1000}) {
    const double speed = 1e-4 / length;
    FallingSheet sheet{0.1, 10, thickness_of_sheet, 0, Vector3(0, -speed, 0), length};
    const Corners corners = sheet.path.triangles[sheet.path.triangles.size() / 2];
    const Vector3 middle = (sheet.start[corners[0]] + sheet.start[corners[1]]) / 2;
    const double radius = 1e-3;
    const solid::Solids ball = solids_of({solid(scene::Sphere{radius}, middle - Vector3(0, radius + 3e-4, 0))});
    EXPECT_GE(resolve_solids(sheet.path, ball).pushed, 2U);
    const Vector3 end = (sheet.path.end[corners[0]] + sheet.path.end[corners[1]]) / 2;
    const Vector3 velocity = (sheet.path.velocity[corners[0]] + sheet.path.velocity[corners[1]]) / 2;
    EXPECT_NEAR((end - middle).y(), 2e-4, 2e-5) << length;
    EXPECT_LT(velocity.norm(), 0.01 * speed) << length;
  }
}

// A film far thinner than its triangles' chords comes down on a ball: its vertices are held, its triangles are not
// pushed in step after step.
TEST(SolidContact, FilmsTouchByTheirVertices) {
  constexpr double radius = 0.05, film = 2e-5;
  const solid::Solids ball = solids_of({solid(scene::Sphere{radius}, {0, -radius, 0})});
  FallingSheet sheet(0.1, 10, film, 2e-3, {0, -1, 0}, 1e-3);
  std::size_t pushed = 0, touching = 0;
  for (int step = 0; step < 20; ++step) {
    const SolidReport report = resolve_solids(sheet.path, ball);
    EXPECT_EQ(report.unresolved, 0U);
    pushed += report.pushed;
    touching = report.touching;
    sheet.go_on();
  }
  EXPECT_GT(touching, 40U);        // of 121, within 30 mm of the top
  EXPECT_LT(pushed, 2 * touching); // at the first touch, not again and again
  for (std::size_t v = 0; v < sheet.start.size(); ++v)
    if (sheet.path.touch[v] != no_solid) {
      EXPECT_LT((sheet.start[v] + Vector3(0, radius, 0)).norm(), radius + 2e-3);
    }
}

// What touches makes room for chords bit by bit as the sheet beside it comes down, and is not brought in again when
// chords become shallower.
TEST(SolidContact, ChordsMakeNothingJump) {
  constexpr double radius = 0.05, film = 2e-5, down = 5e-5;
  const solid::Solids ball = solids_of({solid(scene::Sphere{radius}, {0, -radius, 0})});
  const std::size_t top = 60; // the sheet's middle
  const auto allowance_at = [&](double height) {
    FallingSheet sheet(0.1, 10, film, height, {0, 0, 0}, 1e-3);
    const std::vector<SolidView> views{SolidView(ball, 0, sheet.path, 0.01 * film)};
    return chord_allowances(sheet.path, views, longest_edges(sheet.path.start, sheet.path.triangles))[top];
  };
  double last = allowance_at(1e-4), greatest = 0, least = last;
  for (double height = 1e-4 + down; height < 0.015; height += down) {
    const double allowance = allowance_at(height);
    EXPECT_LT(std::abs(allowance - last), down) << height;
    last = allowance;
    greatest = std::max(greatest, allowance);
    least = std::min(least, allowance);
  }
  EXPECT_GT(greatest, 2e-4); // an edge of 10 mm is 0.25 mm deep
  EXPECT_EQ(least, 0);
  const double height = 1e-3, above = 1.5 * allowance_at(height);
  FallingSheet stuck(0.1, 10, film, height, {0, 0, 0}, 1e-3);
  stuck.path.touch.assign(stuck.start.size(), no_solid);
  stuck.path.touch[top] = 0;
  stuck.start[top].y() = stuck.path.end[top].y() = above;
  stuck.path.start = stuck.start;
  resolve_solids(stuck.path, ball);
  EXPECT_NEAR(stuck.path.end[top].y(), above, 1e-9);
  EXPECT_EQ(stuck.path.touch[top], 0);
}

// Within limits it stays where it stands, or it would go up and down at the edge of what the triangles beside it allow.
TEST(SolidContact, WhatSticksStaysWhereItStands) {
  const solid::Solids ground = solids_of({solid(scene::HalfSpace{{0, 1, 0}})});
  const auto end_of = [&](double start) {
    FallingSheet stuck = falling(0, start * thickness_of_sheet);
    stuck.path.touch.assign(stuck.start.size(), 0);
    resolve_solids(stuck.path, ground);
    return stuck.path.end[0].y() / thickness_of_sheet;
  };
  EXPECT_NEAR(end_of(0.2), 0.25, 1e-9);
  EXPECT_NEAR(end_of(0.4), 0.4, 1e-9);
  EXPECT_NEAR(end_of(0.7), 0.7, 1e-9);
  EXPECT_NEAR(end_of(0.95), 0.9, 1e-9);
}

TEST(SolidContact, HoldsAreLeftAlone) {
  const solid::Solids ball = solids_of({solid(scene::Sphere{0.03}, {0, -0.03, 0})});
  FallingSheet sheet = falling(1);
  sheet.path.fixed[0] = sheet.path.fixed[60] = all_axes;
  const Vector3 corner = sheet.path.end[0], middle = sheet.path.end[60];
  const SolidReport report = resolve_solids(sheet.path, ball);
  EXPECT_EQ(sheet.path.end[0], corner);
  EXPECT_EQ(sheet.path.end[60], middle);
  EXPECT_EQ(sheet.path.touch[60], no_solid);
  EXPECT_GT(report.unresolved, 0U); // the held middle goes through the ball, and the report says so
}

// What is held altogether cannot be kept out, but it is told; where it starts in the solid, as in a clamp, it is meant
// so.
TEST(SolidContact, WhatHoldsDriveIntoASolidIsTold) {
  const solid::Solids ball = solids_of({solid(scene::Sphere{0.03}, {0, -0.03, 0})});
  FallingSheet sheet = falling(1);
  std::ranges::fill(sheet.path.fixed, all_axes);
  const std::vector<Vector3> end = sheet.path.end;
  EXPECT_GT(resolve_solids(sheet.path, ball).unresolved, 0U);
  EXPECT_EQ(sheet.path.end, end);
  FallingSheet clamped = falling(0, -0.02);
  std::ranges::fill(clamped.path.fixed, all_axes);
  EXPECT_EQ(resolve_solids(clamped.path, ball).unresolved, 0U);
}

TEST(SolidContact, BetweenTwoSolids) {
  const solid::Solids solids =
      solids_of({solid(scene::HalfSpace{{0, 1, 0}}), solid(scene::Sphere{0.02}, {0, 0.01, 0})});
  FallingSheet sheet = falling(1, 0.035);
  const SolidReport report = resolve_solids(sheet.path, solids);
  EXPECT_EQ(report.unresolved, 0U);
  bool ground = false, ball = false;
  for (std::size_t v = 0; v < sheet.start.size(); ++v) {
    ground = ground || sheet.path.touch[v] == 0;
    ball = ball || sheet.path.touch[v] == 1;
    EXPECT_GE(distance_at_end(sheet, solids, v, 0), thickness_of_sheet / 8);
    EXPECT_GE(distance_at_end(sheet, solids, v, 1), thickness_of_sheet / 8);
  }
  EXPECT_TRUE(ground);
  EXPECT_TRUE(ball);
  EXPECT_GE(test::least_distance(sheet.path, solids, 0, 1e-4, 10), thickness_of_sheet / 8 - 1e-9);
  EXPECT_GE(test::least_distance(sheet.path, solids, 1, 1e-4, 10), thickness_of_sheet / 8 - 1e-9);
}

TEST(SolidContact, StartingInsideIsRefused) {
  const solid::Solids ball = solids_of({solid(scene::Sphere{0.03})});
  FallingSheet sheet = falling(1, 0.01);
  try {
    resolve_solids(sheet.path, ball);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("m inside solid 0 (sphere)"),
                                             testing::HasSubstr("vertex"), testing::HasSubstr("start apart")));
  }
}

// As a change of the mesh on a curved solid may leave them: a little inside, by more than half the thickness and less
// than half an edge.
TEST(SolidContact, StartingALittleInsideIsBroughtOut) {
  const solid::Solids ball = solids_of({solid(scene::Sphere{0.03})});
  FallingSheet sheet = falling(0, 0.03 - 0.8 * thickness_of_sheet);
  const SolidReport report = resolve_solids(sheet.path, ball);
  EXPECT_GT(report.brought_out, 0U);
  EXPECT_EQ(report.unresolved, 0U);
  for (std::size_t v = 0; v < sheet.path.end.size(); ++v)
    EXPECT_GT(distance_at_end(sheet, ball, v), 0.49 * thickness_of_sheet);
}

// A rod that runs through the sheet from the start is brought to one side of it.
TEST(SolidContact, StartingAcrossIsBroughtOut) {
  const solid::Solids rod = solids_of({lying_rod(1e-4)});
  FallingSheet sheet = falling(0, 1e-5);
  const SolidReport report = resolve_solids(sheet.path, rod);
  EXPECT_GT(report.started_across, 0U);
  EXPECT_EQ(report.unresolved, 0U);
  sheet.path.start = sheet.path.end;
  EXPECT_GE(test::least_distance(sheet.path, rod, 0, 1e-4, 1), thickness_of_sheet / 8 - 1e-5);
}

TEST(SolidContact, SameBitsForAnyNumberOfThreads) {
  std::vector<Vector3> first;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const solid::Solids solids = solids_of({lying_rod(1e-3), solid(scene::Sphere{0.02}, {0.03, -0.02, 0})});
    FallingSheet sheet = falling(30);
    resolve_solids(sheet.path, solids);
    if (first.empty())
      first = sheet.path.end;
    EXPECT_EQ(sheet.path.end, first);
  }
}

// Many steps of falling onto a ball and hanging there.
TEST(SolidContact, ManySteps) {
  const solid::Solids ball = solids_of({solid(scene::Sphere{0.03}, {0, -0.03, 0})});
  FallingSheet sheet(0.1, 16, thickness_of_sheet, 2e-3, {0, -0.2, 0}, 2e-3);
  for (int step = 0; step < 60; ++step) {
    const SolidReport report = resolve_solids(sheet.path, ball);
    ASSERT_EQ(report.unresolved, 0U) << step;
    ASSERT_EQ(report.started_across, 0U) << step;
    ASSERT_GE(test::least_distance(sheet.path, ball, 0, 2e-4, 1), 0.999 * thickness_of_sheet / 8) << step;
    sheet.go_on();
  }
}

// A symmetry plane: held along x, vertices come to lie on a slope like the others, and do not leave the plane.
TEST(SolidContact, HeldAlongOneAxis) {
  const solid::Solids slope = solids_of({solid(scene::HalfSpace{Vector3(1, 2, 0)}, {0, -0.06, 0})});
  FallingSheet sheet = falling(3);
  for (std::size_t v = 0; v < sheet.start.size(); ++v)
    if (sheet.start[v].x() < -0.0499)
      sheet.path.fixed[v] = 1;
  const SolidReport report = resolve_solids(sheet.path, slope);
  EXPECT_EQ(report.touching, sheet.start.size());
  EXPECT_EQ(report.unresolved, 0U);
  std::size_t held = 0;
  for (std::size_t v = 0; v < sheet.start.size(); ++v) {
    EXPECT_NEAR(distance_at_end(sheet, slope, v), thickness_of_sheet / 2, 1e-11);
    if (sheet.start[v].x() >= -0.0499)
      continue;
    ++held;
    EXPECT_EQ(sheet.path.end[v].x(), sheet.start[v].x());
    EXPECT_EQ(sheet.path.fixed[v], all_axes);
  }
  EXPECT_EQ(held, 11U);
}

// A touch bit far from the solid, as remeshing over a hollow makes it, holds nothing.
TEST(SolidContact, WhatTouchesNothingIsLetGo) {
  const solid::Solids ground = solids_of({solid(scene::HalfSpace{{0, 1, 0}})});
  FallingSheet sheet = falling(0, 3 * thickness_of_sheet);
  sheet.path.touch.assign(sheet.start.size(), 0);
  const auto end = sheet.path.end;
  EXPECT_EQ(resolve_solids(sheet.path, ground).touching, 0U);
  EXPECT_EQ(sheet.path.end, end);
  EXPECT_EQ(sheet.path.touch, std::vector<std::int32_t>(end.size(), no_solid));
}

// What flows and starts as far, as new vertices beside a hold do that keeps its distance while the layer thins, stays
// on the wall to which sheet-step has brought it back, if not wholly.
TEST(SolidContact, WhatIsBroughtBackToItsWallStaysOnIt) {
  scene::Solid wall = solid(scene::HalfSpace{{0, 1, 0}});
  for (const auto& [contact, touched] : {std::pair(SolidContact::flow, 0), std::pair(SolidContact::stick, no_solid)}) {
    wall.contact = contact;
    FallingSheet sheet = falling(0, 3 * thickness_of_sheet);
    sheet.path.touch.assign(sheet.start.size(), 0);
    for (Vector3& end : sheet.path.end)
      end.y() = 0.6 * thickness_of_sheet;
    resolve_solids(sheet.path, solids_of({wall}));
    EXPECT_EQ(sheet.path.touch, std::vector<std::int32_t>(sheet.start.size(), touched));
  }
}

// What a hold leads along one axis keeps the height to which sheet-step has brought it, as what is free does.
TEST(SolidContact, WhatAHoldLeadsKeepsItsHeightWhereItFlows) {
  scene::Solid wall = solid(scene::HalfSpace{{0, 1, 0}});
  wall.contact = SolidContact::flow;
  for (const Axes led : {Axes{0}, axis_bit(2)}) {
    FallingSheet sheet = falling(0, 0.5 * thickness_of_sheet);
    sheet.path.touch.assign(sheet.start.size(), 0);
    sheet.path.fixed.assign(sheet.start.size(), led);
    for (Vector3& end : sheet.path.end)
      end.y() = 0.4 * thickness_of_sheet;
    const auto end = sheet.path.end;
    resolve_solids(sheet.path, solids_of({wall}));
    for (std::size_t v = 0; v < end.size(); ++v)
      EXPECT_NEAR((sheet.path.end[v] - end[v]).norm(), 0, 1e-12) << v;
  }
}

// What is across a solid with a corner that is held there stays: its free corners cannot bring it out.
TEST(SolidContact, FreeCornersDoNotBringOutWhatIsHeldInside) {
  const solid::Solids rod = solids_of({solid(scene::Capsule{5e-3, 0.1}, {0, -0.05, 0})});
  FallingSheet sheet = falling(0);
  sheet.triangles = {{0, 1, 2}};
  sheet.path.triangles = sheet.triangles;
  sheet.start = {{-0.01, -0.05, 0}, {0.02, -0.05, -0.01}, {0.02, -0.05, 0.01}};
  sheet.path.start = sheet.path.end = sheet.start;
  for (auto* list : {&sheet.path.thickness, &sheet.path.mass})
    list->assign(3, thickness_of_sheet);
  sheet.path.touch.assign(3, no_solid);
  sheet.path.fixed = {all_axes, 0, 0};
  sheet.path.velocity.assign(3, Vector3::Zero());
  EXPECT_GT(resolve_solids(sheet.path, rod).started_across, 0U);
  for (std::size_t v = 0; v < 3; ++v)
    EXPECT_EQ(sheet.path.end[v], sheet.start[v]) << v;
}

// The corners of each triangle and the triangles themselves in another order, and the sheet mirrored: another input of
// the same step, with the same result up to round-off.
TEST(SolidContact, NeitherOrderNorSideMatters) {
  const std::vector<scene::SolidShape> shapes{scene::Sphere{4e-3}, scene::Capsule{2e-3, 0.01},
                                              scene::SolidBox{{4e-3, 0.01, 6e-3}}, scene::Cylinder{3e-3, 0.01}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto below = [&](double side) { return solids_of({solid(shapes[i], {side * 0.0131, -8e-3, 0.0073})}); };
    FallingSheet sheet = falling(0.4), turned = falling(0.4), mirrored = falling(0.4);
    for (std::size_t t = 0; t < turned.triangles.size(); ++t) {
      const auto [a, b, c] = turned.triangles[t];
      turned.triangles[t] = t % 2 == 0 ? Corners{b, c, a} : Corners{c, a, b};
    }
    std::ranges::reverse(turned.triangles);
    for (std::size_t v = 0; v < mirrored.start.size(); ++v)
      for (Vector3* x : {&mirrored.start[v], &mirrored.path.end[v], &mirrored.path.velocity[v]})
        x->x() *= -1;
    EXPECT_GT(resolve_solids(sheet.path, below(1)).pushed, 0U) << i;
    resolve_solids(turned.path, below(1));
    resolve_solids(mirrored.path, below(-1));
    for (std::size_t v = 0; v < sheet.start.size(); ++v) {
      const Vector3& end = sheet.path.end[v];
      EXPECT_LT((turned.path.end[v] - end).norm(), 1e-9) << i << ": " << v;
      EXPECT_LT((mirrored.path.end[v].cwiseProduct(Vector3(-1, 1, 1)) - end).norm(), 1e-9) << i << ": " << v;
    }
  }
}

// A pin stops a triangle at a point far from its lightest corner, which is not thrown.
TEST(SolidContact, NoLeverThrowsALightCorner) {
  const solid::Solids pin = solids_of({solid(scene::Capsule{1e-5, 0.1}, {0, -0.05, 0})});
  FallingSheet sheet = falling(0.05);
  sheet.triangles = {{0, 1, 2}};
  sheet.path.triangles = sheet.triangles;
  sheet.start = {{-2e-4, 1e-3, -5e-3}, {-2e-4, 1e-3, 5e-3}, {1e-2, 1e-3, 0}};
  sheet.path.start = sheet.start;
  sheet.path.end = sheet.start;
  for (auto* list : {&sheet.path.thickness, &sheet.path.mass})
    list->assign(3, thickness_of_sheet);
  sheet.path.mass[2] *= 1e-6;
  sheet.path.touch.assign(3, no_solid);
  sheet.path.fixed.assign(3, 0);
  const double way = 2e-3;
  sheet.path.velocity.assign(3, Vector3(0, -way / step_length, 0));
  for (Vector3& x : sheet.path.end)
    x.y() -= way;
  const SolidReport report = resolve_solids(sheet.path, pin);
  EXPECT_GT(report.pushed, 0U);
  EXPECT_EQ(report.unresolved, 0U);
  EXPECT_LT((sheet.path.end[2] - sheet.start[2]).norm(), 4 * way);
  EXPECT_GE(test::least_distance(sheet.path, pin, 0, 1e-5, 10), thickness_of_sheet / 8 - 1e-5);
}

// What is brought out is not thrown.
TEST(SolidContact, BroughtOutWithoutSpeed) {
  const solid::Solids rod = solids_of({lying_rod(1e-4)});
  FallingSheet sheet = falling(0, 1e-5);
  EXPECT_GT(resolve_solids(sheet.path, rod).started_across, 0U);
  double moved = 0;
  for (std::size_t v = 0; v < sheet.start.size(); ++v) {
    EXPECT_LT(sheet.path.velocity[v].norm(), 1e-12);
    moved = std::max(moved, (sheet.path.end[v] - sheet.start[v]).norm());
  }
  EXPECT_GT(moved, thickness_of_sheet / 8);
}

} // namespace
} // namespace sheet::collide
