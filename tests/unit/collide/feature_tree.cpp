// SPDX-License-Identifier: GPL-3.0-or-later
// The tree brings the pairs that looking at all of them brings, each once, and told apart as they are.
#include "libsheet/collide/feature_tree.h"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace sheet::collide {
namespace {

struct Moving {
  Connectivity mesh;
  std::vector<Vector3> start, end;
  std::vector<double> reach;

  [[nodiscard]] Ways ways() const { return {start, end, reach}; }
};

// A sheet that is crumpled by this part of its size, with ways as long as that part.
Moving crumpled(int cells, double part, double reach, unsigned seed) {
  Moving m;
  const test::Mesh sheet = test::rectangle(1, 1, cells, cells, 0.2);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-part, part), some(0, reach);
  const auto any = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  for (const Vector3& x : sheet.positions) {
    m.start.push_back(x + any());
    m.end.push_back(m.start.back() + any());
    m.reach.push_back(some(random));
  }
  m.mesh = connect(m.start.size(), sheet.triangles);
  return m;
}

using Pair = FeaturePairs::Pair;
enum class Kind { none, beside, joined, on_way };
using Kinds = std::map<std::pair<bool, Pair>, Kind>; // by: of edges or not

// Fails where a pair stands twice.
Kinds kinds_of(const std::vector<Candidates>& candidates) {
  Kinds kinds;
  const auto put = [&](bool edges, const std::vector<Pair>& pairs, Kind kind) {
    for (const Pair& pair : pairs)
      EXPECT_TRUE(kinds.emplace(std::pair(edges, pair), kind).second) << edges << " " << pair[0] << " " << pair[1];
  };
  for (const Candidates& part : candidates) {
    put(true, part.on_way.edge_edge, Kind::on_way);
    put(true, part.beside.edge_edge, Kind::beside);
    put(false, part.on_way.vertex_triangle, Kind::on_way);
    put(false, part.beside.vertex_triangle, Kind::beside);
    put(false, part.joined, Kind::joined);
  }
  return kinds;
}

class AllPairs {
public:
  AllPairs(const Moving& m, double on_way) : m_(m), on_way_(on_way) {
    for (const Edge& e : m.mesh.edges)
      joins_.insert(e);
  }

  // Calls visit(of edges, pair, features) for all that share no vertex.
  template <class Visit> void each(const Visit& visit) const {
    using Vertices = std::span<const std::uint32_t>;
    const auto look_at = [&](bool edges, Pair pair, Vertices a, Vertices b) {
      if (std::ranges::find_first_of(a, b) == a.end())
        visit(edges, pair, a, b);
    };
    for (std::uint32_t e = 0; e < m_.mesh.edges.size(); ++e)
      for (std::uint32_t f = e + 1; f < m_.mesh.edges.size(); ++f)
        look_at(true, {e, f}, m_.mesh.edges[e], m_.mesh.edges[f]);
    for (std::uint32_t v = 0; v < m_.mesh.vertices; ++v)
      for (std::uint32_t t = 0; t < m_.mesh.triangles.size(); ++t)
        look_at(false, {v, t}, {&v, 1}, m_.mesh.triangles[t]);
  }
  // With boxes in double precision, each larger by a margin.
  [[nodiscard]] Kind kind(bool edges, std::span<const std::uint32_t> a, std::span<const std::uint32_t> b,
                          double margin) const {
    const auto overlap = [&](double part) {
      Box one = m_.ways().way(a).box(part), other = m_.ways().way(b).box(part);
      for (Box* box : {&one, &other})
        *box = {(box->low.array() - margin).matrix(), (box->high.array() + margin).matrix()};
      return one.overlaps(other);
    };
    if (overlap(on_way_))
      return Kind::on_way;
    if (!overlap(1))
      return Kind::none;
    bool joined = false;
    for (const std::uint32_t v : a)
      for (const std::uint32_t w : b)
        joined = joined || joins_.contains({std::min(v, w), std::max(v, w)});
    return !joined ? Kind::beside : edges ? Kind::none : Kind::joined;
  }

private:
  const Moving& m_;
  double on_way_;
  std::set<Edge> joins_;
};

// No pair is told to stay farther apart than it may come, and by rounding alone to come nearer.
void expect_as_all_pairs(const Moving& m, double on_way) {
  double largest = 1;
  for (const Vector3& x : m.start)
    largest = std::max(largest, x.lpNorm<Eigen::Infinity>());
  FeatureTree tree(m.mesh);
  const AllPairs all(m, on_way);
  for (int time = 0; time < 2; ++time) { // the second one with the order of the first
    Kinds found = kinds_of(tree.candidates(m.ways(), on_way, true, {}));
    const Kinds moving = kinds_of(tree.candidates(m.ways(), on_way, false, {}));
    all.each([&](bool edges, const Pair& pair, auto a, auto b) {
      const Kind is = found[{edges, pair}];
      EXPECT_GE(is, all.kind(edges, a, b, 0)) << edges << " " << pair[0] << " " << pair[1];
      EXPECT_LE(is, all.kind(edges, a, b, 2e-6 * largest)) << edges << " " << pair[0] << " " << pair[1];
      EXPECT_EQ(moving.contains({edges, pair}), is == Kind::on_way);
    });
  }
}

TEST(FeatureTree, PairsAreThoseOfAllPairs) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    expect_as_all_pairs(crumpled(1, 0.1, 0.1, seed), 0.1);
    expect_as_all_pairs(crumpled(8, 0.0, 0.3, seed), 0.1); // flat, without ways
    expect_as_all_pairs(crumpled(8, 0.02, 0.2, seed), 0.1);
    expect_as_all_pairs(crumpled(8, 0.2, 0.05, seed), 0.5);
    expect_as_all_pairs(crumpled(6, 1.0, 0.01, seed), 0.1); // all over all
  }
}

TEST(FeatureTree, DegenerateSheets) {
  Moving far = crumpled(8, 0.02, 0.1, 1);
  for (auto* places : {&far.start, &far.end})
    for (Vector3& x : *places)
      x += Vector3(1e6, -1e6, 1e6); // half an edge to the next number in single precision
  expect_as_all_pairs(far, 0.1);
  Moving point = crumpled(5, 0, 0, 1);
  std::ranges::fill(point.start, Vector3(0.1, 0.2, 0.3));
  point.end = point.start;
  expect_as_all_pairs(point, 0.1);
  Moving line = crumpled(5, 0, 0, 1);
  for (Vector3& x : line.start)
    x = Vector3(0.1 * std::round(10 * x.x()), 0, 0); // boxes that touch
  line.end = line.start;
  expect_as_all_pairs(line, 0.1);
  expect_as_all_pairs({connect(3, {}), std::vector<Vector3>(3, Vector3::Zero()),
                       std::vector<Vector3>(3, Vector3::Zero()), std::vector<double>(3, 1)},
                      0.1);
}

TEST(FeatureTree, ChosenVerticesHaveTheirPairs) {
  const Moving m = crumpled(10, 0.05, 0.1, 2);
  std::vector<std::uint8_t> chosen(m.mesh.vertices, 0);
  for (std::size_t v = 0; v < chosen.size(); v += 20)
    chosen[v] = 1;
  FeatureTree tree(m.mesh);
  const Kinds all = kinds_of(tree.candidates(m.ways(), 0.1, true, {}));
  const Kinds some = kinds_of(tree.candidates(m.ways(), 0.1, true, chosen));
  EXPECT_LT(some.size(), all.size());
  AllPairs(m, 0.1).each([&](bool edges, const Pair& pair, auto a, auto b) {
    const auto with = [&](auto feature) {
      return std::ranges::any_of(feature, [&](std::uint32_t v) { return chosen[v] != 0; });
    };
    const auto whole = all.find({edges, pair}), part = some.find({edges, pair});
    EXPECT_EQ(part != some.end(), whole != all.end() && (with(a) || with(b)))
        << edges << " " << pair[0] << " " << pair[1];
    if (part != some.end()) {
      EXPECT_EQ(part->second, whole->second);
    }
  });
}

TEST(FeatureTree, WhatHasMovedIsPlacedAnew) {
  Moving m = crumpled(10, 0.05, 0.1, 3);
  FeatureTree kept(m.mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> by(-0.3, 0.3);
  for (std::uint32_t round = 0; round < 6; ++round) {
    const bool beside = round % 3 == 0;
    std::vector<std::uint8_t> chosen(m.mesh.vertices, 0);
    for (std::size_t v = round; v < chosen.size(); v += 17) {
      m.end[v] += Vector3(by(random), by(random), by(random));
      m.reach[v] *= 1 + by(random);
      chosen[v] = 1;
    }
    if (round == 4)
      (void)kept.triangles_at(m.start);
    FeatureTree fresh(m.mesh);
    const std::span<const std::uint8_t> of = round % 2 == 0 ? std::span<const std::uint8_t>() : chosen;
    EXPECT_EQ(kinds_of(kept.candidates(m.ways(), 0.1, beside, of)),
              kinds_of(fresh.candidates(m.ways(), 0.1, beside, of)))
        << round;
  }
}

} // namespace
} // namespace sheet::collide
