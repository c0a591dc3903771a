// SPDX-License-Identifier: GPL-3.0-or-later
// The search by boxes finds what looking at everything finds.
#include "libsheet/collide/self_search.h"

#include <map>
#include <mutex>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/measure/intersections.h"
#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

std::vector<Vector3> scattered(std::size_t count, unsigned seed, double size) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  return points;
}

TEST(BoxTree, FindsEachPairOnce) {
  for (const std::size_t count : {0UL, 1UL, 2UL, 5UL, 300UL, 1000UL}) {
    const auto middles = scattered(count, 1, 1), extents = scattered(count, 2, 0.1);
    std::vector<Box> boxes(count);
    std::vector<std::uint8_t> chosen(count);
    for (std::size_t i = 0; i < count; ++i) {
      boxes[i].add(middles[i] - extents[i].cwiseAbs(), 0);
      boxes[i].add(middles[i] + extents[i].cwiseAbs(), 0.01);
      chosen[i] = i % 3 == 0;
    }
    const auto quick = [&] { return std::vector<QuickBox>(boxes.begin(), boxes.end()); };
    BoxTree tree;
    tree.build(quick());
    for (auto& box : boxes) // as a step would move them
      box.low -= Vector3(0.02, 0.01, 0);
    tree.refit(quick());
    for (const bool all : {true, false}) {
      std::mutex mutex;
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> found;
      tree.for_overlaps(all ? std::span<const std::uint8_t>() : chosen,
                        [&](std::size_t chunk, std::uint32_t i, std::uint32_t j) {
                          const std::lock_guard lock(mutex);
                          EXPECT_LT(chunk, tree.chunks());
                          ++found[std::minmax(i, j)];
                        });
      for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i + 1; j < count; ++j) {
          const bool wanted = boxes[i].overlaps(boxes[j]) && (all || chosen[i] != 0 || chosen[j] != 0);
          const auto at = found.find({i, j});
          EXPECT_EQ(at == found.end() ? 0 : at->second, wanted ? 1 : 0) << i << " " << j;
        }
    }
  }
}

struct Sheets {
  std::vector<Vector3> start, end;
  std::vector<double> reach;
  Connectivity mesh;

  explicit Sheets(unsigned seed, double way) {
    std::vector<Corners> triangles;
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
      const test::Mesh one = test::rectangle(1, 1, 4, 4, 0.2);
      for (const Corners& t : one.triangles)
        triangles.push_back({t[0] + 25 * layer, t[1] + 25 * layer, t[2] + 25 * layer});
      for (const Vector3& x : one.positions)
        start.push_back(x + Vector3(0.011, 0.017, 0.1) * layer);
    }
    end = start;
    const auto ways = scattered(end.size(), seed, way);
    for (std::size_t v = 0; v < end.size(); ++v)
      end[v] += ways[v];
    reach.assign(start.size(), 0.05);
    mesh = connect(start.size(), triangles);
  }

  template <class Visit> void for_pairs(Visit&& visit) const {
    for (std::uint32_t v = 0; v < start.size(); ++v)
      for (const Corners& t : mesh.triangles)
        if (v != t[0] && v != t[1] && v != t[2])
          visit(FeaturePair{Features::vertex_triangle, {v, t[0], t[1], t[2]}});
    for (std::size_t i = 0; i < mesh.edges.size(); ++i)
      for (std::size_t j = i + 1; j < mesh.edges.size(); ++j) {
        const Edge &a = mesh.edges[i], &b = mesh.edges[j];
        if (a[0] != b[0] && a[0] != b[1] && a[1] != b[0] && a[1] != b[1])
          visit(FeaturePair{Features::edge_edge, {a[0], a[1], b[0], b[1]}});
      }
  }
};

TEST(SelfSearch, HitsAreThoseOfAllPairs) {
  const Sheets s(1, 0.2);
  SelfSearch search(s.mesh);
  std::set<FeaturePair> found;
  for (const Hit& hit : search.hits(s.start, s.end, s.reach))
    EXPECT_TRUE(found.insert(hit.pair).second);
  std::size_t wanted = 0;
  s.for_pairs([&](const FeaturePair& pair) {
    SweptPair swept{pair.features, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      swept.start[i] = s.start[pair.vertices[i]];
      swept.end[i] = s.end[pair.vertices[i]];
    }
    if (first_contact(swept, {.gap = 0.0049, .time_tolerance = 1e-4})) {
      ++wanted;
      EXPECT_TRUE(found.contains(pair));
    }
    if (!first_contact(swept, {.gap = 0.0051, .time_tolerance = 1e-4})) {
      EXPECT_FALSE(found.contains(pair));
    }
  });
  EXPECT_GT(wanted, 20u);
}

// Ends that go on by more or less each time, of few vertices and of many.
TEST(SelfSearch, WatchedHitsAreThoseThatHaveAVertexThatMoved) {
  const Sheets s(1, 0.2);
  SelfSearch search(s.mesh);
  (void)search.hits(s.start, s.end, s.reach);
  std::vector<Vector3> end = s.end;
  PairWatch watch = search.watch(s.start, end, s.reach);
  std::size_t wanted = 0, left_out = 0;
  for (unsigned round = 0; round < 24; ++round) {
    const std::size_t every = 1 + round % 5 * 3;
    const double by = std::array{0.001, 0.01, 0.05}[round % 3];
    const auto ways = scattered(end.size(), 10 + round, by);
    std::vector<std::uint8_t> moved(end.size(), 0);
    for (std::size_t v = round % every; v < end.size(); v += every) {
      end[v] += ways[v];
      moved[v] = 1;
    }
    std::vector<FeaturePair> pairs, found;
    for (const Hit& hit : SelfSearch(s.mesh).hits(s.start, end, s.reach)) {
      const auto& v = hit.pair.vertices;
      const bool has_one = (moved[v[0]] | moved[v[1]] | moved[v[2]] | moved[v[3]]) != 0;
      (has_one ? wanted : left_out) += 1;
      if (has_one)
        pairs.push_back(hit.pair);
    }
    for (const Hit& hit : watch.hits(end))
      found.push_back(hit.pair);
    EXPECT_EQ(found, pairs) << round;
  }
  EXPECT_GT(wanted, 1000u);
  EXPECT_GT(left_out, 1000u);
}

TEST(SelfSearch, NearAreThoseThatFaceEachOther) {
  // a sheet that lies flat has no contact with itself, however thick it is; two layers have
  Sheets s(1, 0);
  std::fill(s.reach.begin(), s.reach.end(), 0.4);
  SelfSearch search(s.mesh);
  std::size_t edges = 0, vertices = 0;
  for (const NearPair& near : search.near(s.start, s.reach)) {
    const auto layer = [](std::uint32_t v) { return v / 25; };
    const auto& v = near.pair.vertices;
    const bool edge = near.pair.features == Features::edge_edge;
    EXPECT_NE(layer(v[0]), layer(v[edge ? 2 : 1]));
    (edge ? edges : vertices) += 1;
    Vector3 c = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
      c += near.closest.weights[i] * s.start[v[i]];
    EXPECT_LT((c - near.closest.offset).norm(), 1e-15);
  }
  EXPECT_GE(vertices, 4u * 16); // nearly all vertices over the layer below and below the one above
  EXPECT_GT(edges, 50u);
  // what a spring joins is left out, with what has vertices of both its features in common with it
  const std::vector<NearPair> all = search.near(s.start, s.reach);
  const auto& first = all.front().pair;
  ASSERT_EQ(first.features, Features::vertex_triangle);
  ContactSpring spring;
  spring.vertices = first.vertices;
  spring.weights = {1, 0, 0, -1};
  const std::vector<NearPair> rest = search.near(s.start, s.reach, LinkedVertices({&spring, 1}));
  EXPECT_LT(rest.size(), all.size());
  EXPECT_TRUE(std::ranges::none_of(rest, [&](const NearPair& near) { return near.pair == first; }));
  EXPECT_TRUE(std::ranges::any_of(rest, [&](const NearPair& near) {
    return near.pair.features == Features::vertex_triangle && near.pair.vertices[0] == first.vertices[1];
  })); // the other way
  std::fill(s.reach.begin(), s.reach.end(), 0.09);
  EXPECT_TRUE(search.near(s.start, s.reach).empty());
}

// What was gathered for other places changes no answer, whether a few vertices have left them or all.
TEST(SelfSearch, AnswersDoNotDependOnThePlacesBefore) {
  const Sheets s(1, 0.2);
  for (const std::size_t every : {1UL, 2UL, 10UL, 1000UL}) {
    SelfSearch search(s.mesh);
    search.gather(s.start, s.end, s.reach);
    std::vector<Vector3> start = s.start, end = s.end;
    std::vector<double> reach = s.reach;
    for (std::size_t v = 0; v < end.size(); v += every) {
      end[v] -= 3 * (s.end[v] - s.start[v]);
      start[v] += Vector3(0.01, -0.02, 0.03);
      reach[v / 2] = 0.2;
    }
    const auto pairs_of = [](const auto& found) {
      std::vector<FeaturePair> pairs;
      for (const auto& f : found)
        pairs.push_back(f.pair);
      return pairs;
    };
    const auto hits = pairs_of(SelfSearch(s.mesh).hits(start, end, reach));
    EXPECT_NE(hits, pairs_of(search.hits(s.start, s.end, s.reach))); // the places matter
    EXPECT_EQ(pairs_of(search.hits(start, end, reach)), hits) << every;
    EXPECT_EQ(pairs_of(search.near(end, reach)), pairs_of(SelfSearch(s.mesh).near(end, reach))) << every;
    EXPECT_EQ(search.crossing(end), SelfSearch(s.mesh).crossing(end)) << every;
    EXPECT_EQ(pairs_of(search.hits(start, end, reach)), hits) << every;
  }
}

TEST(SelfSearch, CrossingOfChosenTriangles) {
  const Sheets s(1, 0.2);
  const auto crossing = SelfSearch(s.mesh).crossing(s.end);
  ASSERT_TRUE(crossing);
  std::vector<std::uint8_t> chosen(s.mesh.triangles.size(), 0);
  EXPECT_FALSE(SelfSearch(s.mesh).crossing(s.end, chosen));
  chosen[crossing->second] = 1;
  EXPECT_EQ(SelfSearch(s.mesh).crossing(s.end, chosen)->second, crossing->second);
}

TEST(SelfSearch, CrossingIsFound) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Sheets s(seed, 0.06);
    const auto crossing = SelfSearch(s.mesh).crossing(s.end);
    const auto exact = find_intersections(s.end, s.mesh.triangles, std::vector<bool>(s.mesh.triangles.size(), true), 1);
    ASSERT_EQ(crossing.has_value(), exact.count > 0) << seed;
    if (crossing) {
      EXPECT_EQ(crossing->first, exact.pairs[0].first);
      EXPECT_EQ(crossing->second, exact.pairs[0].second);
    }
  }
}

} // namespace
} // namespace sheet::collide
