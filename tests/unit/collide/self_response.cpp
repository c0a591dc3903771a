// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a step is free of intersections whatever is asked for; what free parts do to each other conserves
// momentum.
#include "libsheet/collide/self_response.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "libsheet/collide/rigid_group.h"
#include "libsheet/measure/intersections.h"
#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

struct Case {
  std::vector<Vector3> start;
  std::vector<Corners> triangles;
  StepPath path;
  std::vector<double> reach;

  // Layers of n x n cells of size 1/n at distance `apart`.
  Case(int layers, int n, double apart) {
    for (int layer = 0; layer < layers; ++layer) {
      const test::Mesh mesh = test::rectangle(1, 1, n, n, 0.2);
      const auto first = static_cast<std::uint32_t>(start.size());
      for (const Vector3& x : mesh.positions)
        start.push_back(x + Vector3(0.013 * layer, 0.007 * layer, apart * layer));
      for (const Corners& t : mesh.triangles)
        triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    path.end_time = 0.1;
    path.end = start;
    path.velocity.assign(start.size(), Vector3::Zero());
    path.thickness.assign(start.size(), 0.02);
    path.mass.assign(start.size(), 1);
    for (std::size_t v = 0; v < start.size(); ++v)
      path.mass[v] = 1 + 0.5 * static_cast<double>(v % 3);
    path.touch.assign(start.size(), no_solid);
    path.fixed.assign(start.size(), 0);
    reach = path.thickness;
  }

  void displace(std::uint32_t v, const Vector3& way) {
    path.end[v] = start[v] + way;
    path.velocity[v] = way / path.length();
  }

  SelfReport resolve(MovingSolids solids = {}, Means means = Means::all) {
    path.triangles = triangles;
    path.start = start;
    const Connectivity mesh = connect(start.size(), triangles);
    SelfSearch search(mesh);
    return resolve_self(path, search, reach, std::nullopt, solids, means);
  }

  [[nodiscard]] double energy() const {
    double sum = 0;
    for (std::uint32_t v = 0; v < start.size(); ++v)
      sum += path.mass[v] * path.velocity[v].squaredNorm() / 2;
    return sum;
  }

  [[nodiscard]] std::uint64_t intersections(double time) const {
    std::vector<Vector3> x;
    for (std::size_t v = 0; v < start.size(); ++v)
      x.push_back(time < 1 ? Vector3((1 - time) * start[v] + time * path.end[v]) : path.end[v]);
    return find_intersections(x, triangles, std::vector<bool>(triangles.size(), true), 1).count;
  }

  void expect_safe() const {
    for (const double time : {0.25, 0.5, 0.75, 1.0})
      EXPECT_EQ(intersections(time), 0u) << "at " << time;
  }
};

void expect_momentum(const Case& c, const std::vector<Vector3>& end, const std::vector<Vector3>& velocity) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t v = 0; v < c.start.size(); ++v)
    all.push_back(v);
  const Momentum before = momentum(all, c.path.mass, end, velocity, Vector3::Zero());
  const Momentum after = momentum(all, c.path.mass, c.path.end, c.path.velocity, Vector3::Zero());
  double size = 0;
  for (const std::uint32_t v : all)
    size += c.path.mass[v] * velocity[v].norm();
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * size);
  EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * size);
}

TEST(SelfResponse, WhatDoesNotHitStays) {
  Case c(2, 4, 0.1);
  for (std::uint32_t v = 0; v < c.start.size(); ++v)
    c.displace(v, {0.3, 0.1, 0.2});
  const std::vector<Vector3> end = c.path.end, velocity = c.path.velocity;
  EXPECT_EQ(c.resolve().hits, 0u);
  EXPECT_EQ(c.path.end, end);
  EXPECT_EQ(c.path.velocity, velocity);
}

// By pull-back alone what hits ends on the way that was asked for.
TEST(SelfResponse, PullBackAloneBringsNothingOffItsWay) {
  Case c(2, 6, 0.1);
  for (std::uint32_t v = 0; v < c.start.size(); ++v)
    c.displace(v, {0.1, 0, v < c.start.size() / 2 ? 0.3 : -0.2});
  for (Axes& fixed : c.path.fixed)
    fixed = all_axes; // else an island goes on as one
  const std::vector<Vector3> asked = c.path.end;
  const SelfReport report = c.resolve({}, Means::pull_back);
  EXPECT_GT(report.pulled_back, 0u);
  EXPECT_EQ(report.by_impulses, 0u);
  c.expect_safe();
  for (std::size_t v = 0; v < asked.size(); ++v)
    EXPECT_LT((c.path.end[v] - c.start[v]).cross(asked[v] - c.start[v]).norm(), 1e-15);
}

// Two sheets that have been put through each other at next to no speed are parted, and the way is no velocity.
TEST(SelfResponse, WhatIsBroughtApartGainsNoEnergy) {
  Case c(2, 6, 0.1);
  for (std::uint32_t v = 0; v < c.start.size(); ++v) {
    c.displace(v, {0, 0, v < c.start.size() / 2 ? 0.3 : -0.2});
    c.path.velocity[v] *= 1e-3;
  }
  const double before = c.energy();
  EXPECT_GT(c.resolve().hits, 0u);
  c.expect_safe();
  EXPECT_LE(c.energy(), before * (1 + 1e-12));
}

// Layers that slide on a floor have no room and stay where they are: their speed along the floor, which the step has
// left the other way than it led them, drives nothing. On a floor that is aslant to the axes all of these are fixed.
TEST(SelfResponse, WhatSlidesAndStaysBehindGainsNoEnergy) {
  for (const Axes fixed : {axis_bit(2), all_axes}) {
    Case c(2, 4, 0.05);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      const Vector3 along(uniform(random), uniform(random), 0);
      c.displace(v, along + Vector3(0, 0, v < c.start.size() / 2 ? 0.2 : 0));
      c.path.fixed[v] = fixed != all_axes || v % 3 == 0 ? fixed : Axes(0);
      c.path.touch[v] = c.path.fixed[v] != 0 ? 0 : no_solid;
      c.path.velocity[v] = -along / c.path.length();
    }
    const double before = c.energy();
    EXPECT_GT(c.resolve().hits, 0u);
    c.expect_safe();
    EXPECT_LE(c.energy(), before * (1 + 1e-12));
  }
}

// Layers between which there is no room for what their floor asks for go on along it as one.
TEST(SelfResponse, WhatHasNoRoomGoesOnAlongItsFloor) {
  const Vector3 along(0.1, -0.04, 0);
  Case c(2, 4, 0.05);
  for (std::uint32_t v = 0; v < c.start.size(); ++v) {
    c.displace(v, along + Vector3(0, 0, v < c.start.size() / 2 ? 0.2 : 0));
    c.path.fixed[v] = axis_bit(2);
  }
  const std::vector<Vector3> velocity = c.path.velocity;
  EXPECT_GT(c.resolve().held_back, 0u);
  c.expect_safe();
  for (std::uint32_t v = 0; v < c.start.size(); ++v) {
    EXPECT_LT((c.path.end[v] - c.start[v] - along).head<2>().norm(), 1e-12);
    EXPECT_LT((c.path.velocity[v] - velocity[v]).norm(), 1e-12);
  }
}

// A pile settles: each layer comes nearer to the one below by a quarter of their distance. Two vertices that flow along
// a floor, one of the lowest layer and the one above, are sent past each other, where there is no room: they stay
// behind, what is around them gives way, and the pile goes on settling.
TEST(SelfResponse, WhatHasNoRoomDoesNotHoldBackThePile) {
  constexpr int layers = 8, cells = 8;
  Case c(layers, cells, 0.003);
  const std::uint32_t of_layer = (cells + 1) * (cells + 1), middle = of_layer / 2;
  for (std::uint32_t v = 0; v < c.start.size(); ++v)
    c.displace(v, {0, 0, -0.0007 * (v / of_layer)}); // NOLINT(bugprone-integer-division)
  for (std::uint32_t v = 0; v < of_layer; ++v) {
    c.path.fixed[v] = all_axes;
    c.path.touch[v] = 0;
  }
  c.path.fixed[of_layer + middle] = all_axes;
  c.path.touch[of_layer + middle] = 0;
  c.displace(middle, {0, 0, 0.004});
  const std::vector<Vector3> end = c.path.end;
  EXPECT_LT(c.resolve().pulled_back, 200u);
  c.expect_safe();
  double asked = 0, got = 0;
  for (std::uint32_t v = 2 * of_layer; v < c.start.size(); ++v) {
    asked += end[v].z() - c.start[v].z();
    got += c.path.end[v].z() - c.start[v].z();
  }
  EXPECT_GT(got / asked, 0.5);
}

// What misses its floor's end by less than a tenth of the contact distance is no trouble.
TEST(SelfResponse, SmallMissesAreNotToldOf) {
  for (const double way : {0.0015, 0.003}) {
    Case c(2, 4, 0.001);
    for (std::uint32_t v = 0; v < c.start.size() / 2; ++v)
      c.displace(v, {0, 0, way});
    std::ranges::fill(c.path.fixed, axis_bit(2));
    const SelfReport report = c.resolve();
    EXPECT_GT(report.pulled_back, 0u);
    EXPECT_EQ(report.held_back > 0, way > 0.1 * 0.02) << way;
    c.expect_safe();
  }
}

// Two sheets change places: each ends on its own side, and their momenta level out.
TEST(SelfResponse, TwoSheetsThroughEachOther) {
  Case c(2, 6, 0.1);
  for (std::uint32_t v = 0; v < c.start.size(); ++v)
    c.displace(v, {0, 0, v < c.start.size() / 2 ? 0.3 : -0.2});
  const std::vector<Vector3> end = c.path.end, velocity = c.path.velocity;
  const SelfReport report = c.resolve();
  EXPECT_GT(report.hits, 0u);
  EXPECT_EQ(report.held_back, 0u);
  c.expect_safe();
  expect_momentum(c, end, velocity);
}

// Ways of several edges at random: nothing is too wild.
TEST(SelfResponse, RandomWays) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Case c(3, 4, 0.05);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double most = seed % 4 == 0 ? 0.05 : seed % 4 == 1 ? 0.2 : seed % 4 == 2 ? 0.5 : 3;
    for (std::uint32_t v = 0; v < c.start.size(); ++v)
      c.displace(v, most * Vector3(uniform(random), uniform(random), uniform(random)));
    const std::vector<Vector3> end = c.path.end, velocity = c.path.velocity;
    const SelfReport report = c.resolve();
    EXPECT_GT(report.hits, 0u) << seed;
    c.expect_safe();
    expect_momentum(c, end, velocity);
  }
}

// A solid at rest brings its layer out by more than there is room: what stays behind has the solid's velocity, not that
// of its way back.
TEST(SelfResponse, WhatASolidBringsOutAndStaysBehindIsAtRest) {
  Case c(2, 4, 0.05);
  for (std::uint32_t v = 0; v < c.start.size(); ++v) {
    c.path.fixed[v] = all_axes;
    if (v < c.start.size() / 2)
      c.path.end[v] = c.start[v] + Vector3(0, 0, 0.2);
  }
  const SelfReport report = c.resolve();
  EXPECT_GT(report.held_back, 0u);
  c.expect_safe();
  for (const Vector3& velocity : c.path.velocity)
    EXPECT_EQ(velocity, Vector3::Zero());
}

// Layers that stick to a solid which turns and goes far, or are kept out of it, and whose places on it are not to be
// had: they go on with it.
TEST(SelfResponse, WhatSticksToAMovingSolidGoesOnWithIt) {
  const Matrix3 turn = Eigen::AngleAxisd(0.3, Vector3(1, 0.3, 0).normalized()).toRotationMatrix();
  const std::vector<SolidMotion> motions{{{turn, Vector3(0.4, 0, -2)}, {}}};
  const RigidStep& step = motions[0].step;
  for (const auto& [told, one_in] : {std::pair(false, 1u), {true, 1u}, {true, 3u}}) { // of so many vertices one touches
    Case c(2, 4, 0.05);
    const std::vector<std::int32_t> kept_out_of(c.start.size(), 0);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      c.path.touch[v] = v % one_in == 0 ? 0 : no_solid;
      c.path.fixed[v] = all_axes;
      c.path.end[v] = step(c.start[v]) + 0.2 * Vector3(uniform(random), uniform(random), uniform(random));
    }
    const SelfReport report = c.resolve({told ? motions : std::vector<SolidMotion>{}, kept_out_of});
    EXPECT_GT(report.pulled_back, 0u);
    c.expect_safe();
    double farthest = 0; // from where the solid takes them
    for (std::uint32_t v = 0; v < c.start.size(); ++v)
      farthest = std::max(farthest, (c.path.end[v] - step(c.start[v])).norm());
    EXPECT_EQ(farthest < 0.35, told);
  }
}

// Held vertices that are sent through the rest, or through each other, stay behind at worst.
TEST(SelfResponse, HeldVerticesSentThroughOthers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Case c(3, 4, 0.05);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      c.displace(v, 0.2 * Vector3(uniform(random), uniform(random), uniform(random)));
      c.path.fixed[v] = uniform(random) < (seed % 2 == 0 ? -0.5 : 0.8) ? all_axes : 0;
    }
    const std::vector<Vector3> end = c.path.end;
    const SelfReport report = c.resolve();
    c.expect_safe();
    std::size_t behind = 0;
    for (std::size_t v = 0; v < end.size(); ++v)
      behind += c.path.fixed[v] == all_axes && c.path.end[v] != end[v];
    EXPECT_EQ(behind, report.held_back);
  }
}

// A held sheet turns, a free one lies close above a part of it: the free one is carried, the held one goes where it
// must.
TEST(SelfResponse, CarriedByAHeldSheetThatTurns) {
  Case c(2, 4, 0.003);
  const Matrix3 turn = Eigen::AngleAxisd(0.5, Vector3(1, 0.3, 0).normalized()).toRotationMatrix();
  for (std::uint32_t v = 0; v < c.start.size() / 2; ++v) {
    c.displace(v, turn * c.start[v] - c.start[v]);
    c.path.fixed[v] = all_axes;
  }
  const SelfReport report = c.resolve();
  EXPECT_EQ(report.held_back, 0u);
  EXPECT_EQ(report.pulled_back, 0u);
  c.expect_safe();
  for (std::uint32_t v = 0; v < c.start.size() / 2; ++v)
    EXPECT_EQ(c.path.end[v], Vector3(c.start[v] + (turn * c.start[v] - c.start[v])));
}

TEST(SelfResponse, TheSameForAnyNumberOfThreads) {
  std::vector<Vector3> first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Case c(3, 12, 0.03);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    for (std::uint32_t v = 0; v < c.start.size(); ++v)
      c.displace(v, Vector3(uniform(random), uniform(random), uniform(random)));
    c.resolve();
    if (first.empty())
      first = c.path.end;
    EXPECT_EQ(c.path.end, first) << threads;
  }
}

// Two layers approach each other between symmetry planes: what is held along x only goes as if it were free.
TEST(SelfResponse, WhatIsHeldAlongSomeAxesRespondsAlongTheOthers) {
  const auto approach = [](Axes rim) {
    Case c(2, 4, 0.03);
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      c.displace(v, Vector3(0, 0, v < c.start.size() / 2 ? 0.02 : -0.05));
      if (c.start[v].x() < 0.02 || c.start[v].x() > 0.99)
        c.path.fixed[v] = rim;
    }
    const std::vector<Vector3> end = c.path.end, velocity = c.path.velocity;
    EXPECT_GT(c.resolve().hits, 0u);
    c.expect_safe();
    Vector3 change = Vector3::Zero();
    double size = 0;
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      for (int a = 0; a < 3; ++a)
        if (has_axis(c.path.fixed[v], a)) {
          EXPECT_EQ(c.path.end[v][a], end[v][a]);
        }
      change += c.path.mass[v] * (c.path.velocity[v] - velocity[v]);
      size += c.path.mass[v] * velocity[v].norm();
    }
    for (int a = 0; a < 3; ++a)
      if (!has_axis(rim, a)) {
        EXPECT_LT(std::abs(change[a]), 1e-11 * size);
      }
    return c.path.end;
  };
  const std::vector<Vector3> free = approach(0), along_x = approach(1);
  double difference = 0, moved = 0;
  for (std::size_t v = 0; v < free.size(); ++v) {
    difference = std::max(difference, std::abs(free[v].z() - along_x[v].z()));
    moved = std::max(moved, std::abs(free[v].z() - (v < free.size() / 2 ? 0.02 : -0.02)));
  }
  EXPECT_LT(difference, 0.1 * moved);
}

// Many random steps with vertices that are sent along prescribed axes.
TEST(SelfResponse, PrescribedAlongSomeAxes) {
  std::size_t behind = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Case c(3, 4, 0.05);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      c.displace(v, 0.1 * Vector3(uniform(random), uniform(random), uniform(random)));
      c.path.fixed[v] = uniform(random) < 0 ? static_cast<Axes>(random() % 8) : 0;
    }
    const std::vector<Vector3> end = c.path.end;
    const SelfReport report = c.resolve();
    c.expect_safe();
    std::size_t altered = 0;
    for (std::size_t v = 0; v < end.size(); ++v)
      altered += (with_fixed(c.path.fixed[v], end[v], c.path.end[v]) - c.path.end[v]).norm() > 0.1 * 0.02;
    EXPECT_EQ(altered, report.held_back);
    behind += altered;
  }
  EXPECT_GT(behind, 0u);
}

// A held vertex comes down beside two held corners of a triangle; the third, which is free and far away, is not thrown.
TEST(SelfResponse, NothingIsThrownByALever) {
  Case c(0, 1, 0);
  c.start = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {0.02, 0.5, 0.02}, {0.02, 0.4, 0.5}, {0.02, 0.6, 0.5}};
  c.triangles = {{0, 2, 1}, {3, 4, 5}};
  c.path.end = c.start;
  c.path.velocity.assign(6, Vector3::Zero());
  c.path.thickness.assign(6, 0.02);
  c.path.mass.assign(6, 1);
  c.path.touch.assign(6, no_solid);
  c.path.fixed = {all_axes, all_axes, 0, all_axes, 0, 0};
  c.reach = c.path.thickness;
  c.displace(3, {0, 0, -0.03});
  EXPECT_GT(c.resolve().hits, 0u);
  c.expect_safe();
  EXPECT_LT((c.path.end[2] - c.start[2]).norm(), 4 * 0.03);
  EXPECT_LT(c.path.velocity[2].norm(), 4 * 0.03 / c.path.length());
}

// Layers that are pressed together between two held ones, with vertices of very different masses: nothing ends farther
// from where it was asked to than all that brings features apart.
TEST(SelfResponse, NothingIsThrownWhereThereIsNoRoom) {
  double farthest = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    constexpr double apart = 0.002, way = 0.004;
    Case c(6, 4, apart);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::size_t layer = c.start.size() / 6;
    for (std::uint32_t v = 0; v < c.start.size(); ++v) {
      const bool held = v < layer || v >= 5 * layer;
      c.path.mass[v] = std::exp(5 * uniform(random));
      c.path.fixed[v] = held && uniform(random) < 0.5 ? all_axes : 0;
      c.displace(v, held ? Vector3(0, 0, v < layer ? way : -way)
                         : Vector3(way * Vector3(uniform(random), uniform(random), uniform(random))));
    }
    const std::vector<Vector3> asked = c.path.end;
    EXPECT_GT(c.resolve().hits, 0u);
    c.expect_safe();
    for (std::size_t v = 0; v < asked.size(); ++v)
      farthest = std::max(farthest, (c.path.end[v] - asked[v]).norm());
  }
  EXPECT_LT(farthest, 2 * (0.004 * std::sqrt(3.0) + 0.5 * 0.02));
}

} // namespace
} // namespace sheet::collide
