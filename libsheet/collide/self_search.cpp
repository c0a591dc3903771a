// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/self_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "libsheet/base/each.h"
#include "libsheet/geometry/triangle_pair.h"

namespace sheet::collide {

namespace {

// Cosine between a triangle's normal and the way to a vertex beside it that still counts as a contact of surfaces.
constexpr double facing = 0.5;

using Four = std::array<std::uint32_t, 4>;

std::array<Vector3, 4> points(std::span<const Vector3> x, const Four& v) {
  return {x[v[0]], x[v[1]], x[v[2]], x[v[3]]};
}

// Contact distance of a pair whose closest points have these weights.
double contact_distance(std::span<const double> reach, const Four& v, const std::array<double, 4>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += std::abs(weights[i]) * reach[v[i]];
  return 0.5 * sum;
}

// Whether an edge of the mesh joins one of the first vertices to one of the others.
bool edge_joins(const Connectivity& mesh, const Four& v, std::size_t first) {
  for (std::size_t i = 0; i < first; ++i)
    for (std::size_t j = first; j < 4; ++j)
      if (std::ranges::binary_search(mesh.edges, Edge{std::min(v[i], v[j]), std::max(v[i], v[j])}))
        return true;
  return false;
}

// The closest points, if the surfaces face each other there.
std::optional<ClosestPoints> facing_points(const Connectivity& mesh, const FeaturePair& pair,
                                           std::span<const Vector3> x) {
  const Four& v = pair.vertices;
  const std::array<Vector3, 4> p = points(x, v);
  if (pair.features == Features::edge_edge) {
    const auto crossing = crossing_edges(p);
    return crossing && !edge_joins(mesh, v, 2) ? crossing : std::nullopt;
  }
  if (const auto over = over_triangle(p))
    return over;
  const double height = std::abs((p[2] - p[1]).cross(p[3] - p[1]).normalized().dot(p[0] - p[1]));
  const Vector3 middle = (p[1] + p[2] + p[3]) / 3;
  const double radius = std::sqrt(
      std::max({(p[1] - middle).squaredNorm(), (p[2] - middle).squaredNorm(), (p[3] - middle).squaredNorm()}));
  if ((p[0] - middle).norm() - radius > height / facing)
    return std::nullopt; // further than that
  const ClosestPoints closest = closest_vertex_triangle(p);
  return height > facing * closest.offset.norm() && !edge_joins(mesh, v, 1) ? std::optional(closest) : std::nullopt;
}

// What work(pair, out) appends to `out`, for the pairs that pairs_of gives of each part, goes to the end of `all`, in
// the order of the pairs.
template <class Found, class PairsOf, class Work>
void for_pairs(const std::vector<Candidates>& parts, const PairsOf& pairs_of, std::vector<Found>& all,
               const Work& work) {
  constexpr std::size_t at_once = 2048;
  std::vector<std::span<const FeaturePairs::Pair>> pieces;
  for (const Candidates& part : parts) {
    const std::span<const FeaturePairs::Pair> pairs = pairs_of(part);
    for (std::size_t begin = 0; begin < pairs.size(); begin += at_once)
      pieces.push_back(pairs.subspan(begin, std::min(at_once, pairs.size() - begin)));
  }
  std::vector<std::vector<Found>> found(pieces.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t k) {
    for (const FeaturePairs::Pair& pair : pieces[k])
      work(pair, found[k]);
  });
  for (const auto& part : found)
    all.insert(all.end(), part.begin(), part.end());
}

} // namespace

// What a test finds in pairs of features, ascending.
template <class Found, class Test> class SelfSearch::Collector {
public:
  // `flags`, one a vertex: which pairs are looked up in the tree.
  Collector(const Connectivity& mesh, std::span<const std::uint8_t> flags, const Test& test)
      : mesh_(mesh), flags_(flags), test_(test) {}

  // The pairs with a flag, or without.
  void look_at(const std::vector<Candidates>& parts, FeaturePairs Candidates::*pairs, bool flagged) {
    const auto vertices = [&](const Candidates& part) { return std::span((part.*pairs).vertex_triangle); };
    const auto edges = [&](const Candidates& part) { return std::span((part.*pairs).edge_edge); };
    for_pairs(parts, vertices, found_, [&](const FeaturePairs::Pair& pair, std::vector<Found>& out) {
      look_at(vertex_triangle(mesh_, pair[0], pair[1]), flagged, out);
    });
    for_pairs(parts, edges, found_, [&](const FeaturePairs::Pair& pair, std::vector<Found>& out) {
      look_at(edge_edge(mesh_, pair[0], pair[1]), flagged, out);
    });
  }
  // Those joined by an edge of the mesh of which the vertex is over the triangle.
  void look_over(const std::vector<Candidates>& parts, std::span<const Vector3> x, bool flagged) {
    const auto joined = [](const Candidates& part) { return std::span(part.joined); };
    for_pairs(parts, joined, found_, [&](const FeaturePairs::Pair& pair, std::vector<Found>& out) {
      const Corners& c = mesh_.triangles[pair[1]];
      if (may_be_over_triangle(x[pair[0]], x[c[0]], x[c[1]], x[c[2]]))
        look_at(vertex_triangle(mesh_, pair[0], pair[1]), flagged, out);
    });
  }

  [[nodiscard]] std::vector<Found> sorted() && {
    tbb::parallel_sort(found_, [](const Found& a, const Found& b) { return a.pair < b.pair; }); // each pair once
    return std::move(found_);
  }

private:
  void look_at(const FeaturePair& pair, bool flagged, std::vector<Found>& out) const {
    const Four& v = pair.vertices;
    if (((flags_[v[0]] | flags_[v[1]] | flags_[v[2]] | flags_[v[3]]) != 0) == flagged)
      test_(pair, out);
  }

  const Connectivity& mesh_;
  std::span<const std::uint8_t> flags_;
  const Test& test_;
  std::vector<Found> found_;
};

SelfSearch::SelfSearch(const Connectivity& mesh) : mesh_(mesh), layers_(mesh), tree_(mesh) {}

// The vertices that are not where the candidates were gathered, or reach farther.
SelfSearch::Flags SelfSearch::outside(const Ways& ways) const {
  Flags flags(mesh_.vertices, 1);
  if (!around_.empty())
    each_in_parallel(flags.size(), [&](std::size_t v) {
      flags[v] = !around_[v].holds(ways.start[v]) || !around_[v].holds(ways.end[v]) || !(ways.reach[v] <= reach_[v]);
    });
  return flags;
}

void SelfSearch::gather(Positions start, Positions end, std::span<const double> reach) {
  const Flags flags = outside({start, end, reach});
  if (4 * std::count(flags.begin(), flags.end(), 1) <= static_cast<std::ptrdiff_t>(flags.size()))
    return; // few pairs to be looked up
  around_.assign(mesh_.vertices, {});
  each_in_parallel(around_.size(), [&](std::size_t v) {
    around_[v].add(start[v], 0);
    around_[v].add(end[v], 0);
  });
  reach_.assign(reach.begin(), reach.end());
  candidates_.clear(); // before there are others: they are most of the memory
  candidates_ = tree_.candidates({start, end, reach}, nearest_part, true, {});
}

std::vector<Hit> SelfSearch::hits(Positions start, Positions end, std::span<const double> reach) {
  gather(start, end, reach);
  const Ways ways{start, end, reach};
  const auto test = [&](const FeaturePair& pair, std::vector<Hit>& out) {
    if (!boxes_overlap(pair, ways, nearest_part))
      return;
    if (const auto hit = hit_or_room(pair, ways).hit)
      out.push_back(*hit);
  };
  const Flags flags = outside(ways);
  Collector<Hit, decltype(test)> collector(mesh_, flags, test);
  collector.look_at(candidates_, &Candidates::on_way, false);
  if (std::ranges::find(flags, 1) != flags.end())
    collector.look_at(tree_.candidates(ways, nearest_part, false, flags), &Candidates::on_way, true);
  return std::move(collector).sorted();
}

std::vector<NearPair> SelfSearch::near(Positions x, std::span<const double> reach, const LinkedVertices& linked) {
  gather(x, x, reach);
  const Ways ways{x, x, reach};
  const auto test = [&](const FeaturePair& pair, std::vector<NearPair>& out) {
    const Four& v = pair.vertices;
    if (pair.features == Features::edge_edge && !may_cross(x[v[0]], x[v[1]], x[v[2]], x[v[3]]))
      return; // nearly all of those of one layer
    const bool of_vertex = pair.features == Features::vertex_triangle;
    if (!boxes_overlap(pair, ways, 1) || (of_vertex && linked.join(v, true)))
      return;
    const auto closest = facing_points(mesh_, pair, x);
    if (!closest || (!of_vertex && linked.join(v, closest->weights[0] == 1)))
      return;
    const double distance = closest->offset.norm();
    if (distance > 0 && distance < contact_distance(reach, pair.vertices, closest->weights))
      out.push_back({pair, *closest});
  };
  const Flags flags = outside(ways);
  Collector<NearPair, decltype(test)> collector(mesh_, flags, test);
  const auto look_at = [&](const std::vector<Candidates>& candidates, bool flagged) {
    collector.look_at(candidates, &Candidates::on_way, flagged);
    collector.look_at(candidates, &Candidates::beside, flagged);
    collector.look_over(candidates, x, flagged);
  };
  look_at(candidates_, false);
  if (std::ranges::find(flags, 1) != flags.end())
    look_at(tree_.candidates(ways, nearest_part, true, flags), true);
  return std::move(collector).sorted();
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> SelfSearch::crossing(Positions x,
                                                                            std::span<const std::uint8_t> chosen) {
  Flags degenerate(mesh_.triangles.size());
  each_in_parallel(degenerate.size(), [&](std::size_t t) { degenerate[t] = corners_collinear(x, mesh_.triangles[t]); });
  const BoxTree& tree = tree_.triangles_at(x);
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(tree.chunks());
  tree.for_overlaps(chosen, [&](std::size_t chunk, std::uint32_t s, std::uint32_t t) {
    if (degenerate[s] == 0 && degenerate[t] == 0 && triangles_intersect(x, mesh_.triangles[s], mesh_.triangles[t]))
      found[chunk].push_back(std::minmax(s, t));
  });
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first;
  for (const auto& part : found)
    for (const auto& pair : part)
      if (!first || pair < *first)
        first = pair;
  return first;
}

} // namespace sheet::collide
