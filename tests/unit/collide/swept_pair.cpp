// SPDX-License-Identifier: GPL-3.0-or-later
// Continuous collision queries: none of those that touch may be missed.
#include "libsheet/collide/swept_pair.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "libsheet/geometry/closest_points.h"
#include "tests/support/exact_touch.h"

namespace sheet::collide {
namespace {

struct Tally {
  int touching = 0, apart = 0, missed = 0, false_alarms = 0;
  void ask(const SweptPair& pair, bool touches) {
    const bool found = first_contact(pair, {}).has_value();
    (touches ? touching : apart) += 1;
    missed += touches && !found;
    false_alarms += found && !touches;
  }
};

void ask_file(const std::filesystem::path& path, Tally& tally) {
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  SweptPair pair;
  pair.features =
      path.filename().string().find("edge-edge") == std::string::npos ? Features::vertex_triangle : Features::edge_edge;
  std::string line;
  for (std::size_t row = 0; std::getline(file, line); ++row) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Vector3 x;
    double numerator = 0, denominator = 0;
    int truth = 0;
    for (int k = 0; k < 3; ++k) {
      words >> numerator >> denominator;
      x[k] = numerator / denominator;
    }
    ASSERT_TRUE(words >> truth) << path << " row " << row;
    (row % 8 < 4 ? pair.start : pair.end)[row % 4] = x;
    if (row % 8 == 7)
      tally.ask(pair, truth != 0);
  }
}

TEST(SweptPair, PublicQueries) {
  Tally tally;
  for (const auto& entry : std::filesystem::directory_iterator(SHEET_SOURCE_DIR "/tests/unit/collide/queries"))
    if (entry.path().extension() == ".csv")
      ask_file(entry.path(), tally);
  EXPECT_EQ(tally.touching + tally.apart, 449);
  EXPECT_GE(tally.touching, 160);
  EXPECT_EQ(tally.missed, 0);
  EXPECT_LE(tally.false_alarms, 10);
}

// Small integers make every kind of degenerate query: touching in vertices and edges, within a plane, at the start.
TEST(SweptPair, RandomQueriesDecidedExactly) {
  for (const int range : {1, 2, 10, 250})
    for (const bool edges : {false, true}) {
      std::mt19937_64 random(static_cast<std::uint64_t>(range));
      std::uniform_int_distribution<int> coordinate(-range, range);
      Tally tally;
      for (int i = 0; i < 3000; ++i) {
        std::array<test::IntegerPoint, 4> start, end;
        SweptPair pair;
        pair.features = edges ? Features::edge_edge : Features::vertex_triangle;
        for (std::size_t p = 0; p < 4; ++p)
          for (std::size_t k = 0; k < 3; ++k) {
            pair.start[p][static_cast<Eigen::Index>(k)] = start[p][k] = coordinate(random);
            pair.end[p][static_cast<Eigen::Index>(k)] = end[p][k] = coordinate(random);
          }
        const test::Touch truth = test::exact_touch(edges, start, end);
        if (truth == test::Touch::undecided)
          continue;
        // far from the origin, tiny, moving together: the same query
        for (std::size_t p = 0; p < 4; ++p) {
          pair.start[p] = (pair.start[p] + Vector3(1024, 0, -512)) * 0x1p-40;
          pair.end[p] = (pair.end[p] + Vector3(-2048, 256, 0)) * 0x1p-40;
        }
        tally.ask(pair, truth == test::Touch::yes);
      }
      EXPECT_GT(tally.touching, 150);
      EXPECT_GT(tally.apart, 1000);
      EXPECT_EQ(tally.missed, 0) << range << edges;
      EXPECT_EQ(tally.false_alarms, 0) << range << edges;
    }
}

SweptPair falling(double height, const Vector3& way) {
  SweptPair pair;
  pair.start = {Vector3(0.25, 0.375, height), Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)};
  pair.end = pair.start;
  pair.end[0] += way;
  return pair;
}

// Within a cube of two; every other one of edges.
SweptPair random_pair(int number, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  SweptPair pair;
  pair.features = number % 2 == 0 ? Features::vertex_triangle : Features::edge_edge;
  for (std::size_t p = 0; p < 4; ++p) {
    pair.start[p] = Vector3(uniform(random), uniform(random), uniform(random));
    pair.end[p] = Vector3(uniform(random), uniform(random), uniform(random));
  }
  return pair;
}

TEST(SweptPair, TimeOfContact) {
  const auto time = first_contact(falling(1, {0, 0, -2}), {.gap = 0.1});
  ASSERT_TRUE(time);
  EXPECT_NEAR(*time, 0.45, 1e-4);
  EXPECT_LE(*time, 0.45);
  EXPECT_FALSE(first_contact(falling(1, {0, 0, -2}), {.gap = 0.1}) == first_contact(falling(1, {0, 0, -2}), {}));
}

TEST(SweptPair, GapCountsFromTheFeature) {
  EXPECT_FALSE(first_contact(falling(1, {0, 0, -0.89}), {.gap = 0.1}));
  EXPECT_TRUE(first_contact(falling(1, {0, 0, -0.91}), {.gap = 0.1}));
}

TEST(SweptPair, CommonMotionIsNone) {
  SweptPair pair = falling(0x1p-20, {0, 0, 0});
  for (Vector3& x : pair.end)
    x += Vector3(8, 4, 2);
  EXPECT_FALSE(first_contact(pair, {.gap = 0.5}));
  EXPECT_TRUE(surely_apart(pair, 0.5));
}

// Slides over the triangle at a distance just above the gap, all the time: a hard "no", within the budget.
TEST(SweptPair, SlidingJustAboveTheGap) {
  EXPECT_FALSE(first_contact(falling(1.01e-3, {0.5, 0.1, 0}), {.gap = 1e-3}));
  EXPECT_TRUE(first_contact(falling(0.99e-3, {0.5, 0.1, 0}), {.gap = 1e-3}));
}

// However near the features come, what remains at the time returned is more than the gap.
TEST(SweptPair, UntilThenTheyAreApart) {
  std::mt19937_64 random(3);
  int contacts = 0;
  for (int i = 0; i < 4000; ++i) {
    const SweptPair pair = random_pair(i, random);
    const double gap = 0.05;
    const auto time = first_contact(pair, {.gap = gap, .time_tolerance = 1e-3});
    contacts += time.has_value();
    for (int step = 0; step <= 50; ++step) {
      const double t = step / 50.0;
      if (time && t >= *time)
        break;
      std::array<Vector3, 4> x;
      for (std::size_t p = 0; p < 4; ++p)
        x[p] = (1 - t) * pair.start[p] + t * pair.end[p];
      const double distance = (i % 2 == 0 ? closest_vertex_triangle(x) : closest_edge_edge(x)).offset.norm();
      ASSERT_GT(distance, gap) << i << " at " << t;
    }
  }
  EXPECT_GT(contacts, 400);
}

// Ends anywhere that together are as far from those given as the room is, no more: still no contact.
TEST(SweptPair, RoomIsForEndsElsewhere) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr double gap = 0.05;
  int with_room = 0;
  double most = 0;
  for (int i = 0; i < 4000; ++i) {
    SweptPair pair = random_pair(i, random);
    const auto [time, exact] = contact_or_room(pair, {.gap = gap, .time_tolerance = 1e-3});
    const double room = std::max(exact, sure_room(pair, gap));
    EXPECT_TRUE(!time || room <= 0);
    EXPECT_EQ(surely_apart(pair, gap), sure_room(pair, gap) > 0);
    if (!(room > 0))
      continue;
    ++with_room;
    most = std::max(most, room);
    std::array<double, 4> part;
    for (double& p : part)
      p = std::abs(uniform(random));
    const double sum = part[0] + part[1] + part[2] + part[3];
    for (std::size_t p = 0; p < 4; ++p)
      pair.end[p] +=
          0.999 * room * part[p] / sum * Vector3(uniform(random), uniform(random), uniform(random)).normalized();
    EXPECT_FALSE(first_contact(pair, {.gap = gap, .time_tolerance = 1e-3})) << i;
  }
  EXPECT_GT(with_room, 1000);
  EXPECT_GT(most, 0.3);
}

TEST(SweptPair, NotANumberIsAContact) { EXPECT_TRUE(first_contact(falling(std::nan(""), {0, 0, -1}), {})); }

} // namespace
} // namespace sheet::collide
