// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/pair_watch.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "libsheet/base/each.h"

namespace sheet::collide {

namespace {

// Of what a vertex reaches: by how much the box around its way is larger than that. Costs pairs, saves questions.
constexpr double spare_part = 0.1;

template <class Flags> bool any_of(const Flags& flags, const FeaturePair& pair) {
  const auto& v = pair.vertices;
  return (flags[v[0]] | flags[v[1]] | flags[v[2]] | flags[v[3]]) != 0;
}

} // namespace

PairWatch::PairWatch(const Connectivity& mesh, FeatureTree& tree, std::span<const Vector3> start,
                     std::span<const Vector3> end, std::span<const double> reach)
    : mesh_(mesh), tree_(tree), start_(start), reach_(reach), end_(end.begin(), end.end()), gone_(end.size(), 0),
      low_(end.size()), high_(end.size()), watched_(end.size(), 0) {
  each_in_parallel(end.size(), [&](std::size_t v) {
    low_[v] = start[v].cwiseMin(end[v]);
    high_[v] = start[v].cwiseMax(end[v]);
  });
}

std::vector<Hit> PairWatch::hits(std::span<const Vector3> end) {
  const Flags moved = follow(end);
  watch(not_watched(moved));
  constexpr std::size_t at_once = 2048;
  const std::size_t pieces = (pairs_.size() + at_once - 1) / at_once;
  std::vector<std::vector<Hit>> found(pieces);
  tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t k) {
    for (std::size_t i = k * at_once; i < std::min((k + 1) * at_once, pairs_.size()); ++i)
      if (any_of(moved, pairs_[i].pair))
        if (const auto hit = look_at(pairs_[i]))
          found[k].push_back(*hit);
  });
  std::vector<Hit> all;
  for (const auto& part : found)
    all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all, {}, &Hit::pair);
  return all;
}

// Which vertices have moved.
PairWatch::Flags PairWatch::follow(std::span<const Vector3> end) {
  Flags moved(end.size(), 0);
  each_in_parallel(end.size(), [&](std::size_t v) {
    if (end[v] == end_[v])
      return;
    moved[v] = 1;
    gone_[v] += (end[v] - end_[v]).norm();
    end_[v] = end[v];
  });
  return moved;
}

PairWatch::Flags PairWatch::not_watched(const Flags& moved) const {
  Flags vertices(moved.size(), 0);
  each_in_parallel(moved.size(), [&](std::size_t v) {
    const auto end = end_[v].array();
    const bool within = (low_[v].array() <= end).all() && (end <= high_[v].array()).all();
    vertices[v] = moved[v] != 0 && (watched_[v] == 0 || !within);
  });
  return vertices;
}

// Seeks the pairs of these vertices, with room for them to move.
void PairWatch::watch(const Flags& vertices) {
  if (std::ranges::find(vertices, 1) == vertices.end())
    return;
  each_in_parallel(vertices.size(), [&](std::size_t v) {
    if (vertices[v] == 0)
      return;
    watched_[v] = 1;
    const double spare = spare_part * reach_[v];
    low_[v] = (start_[v].cwiseMin(end_[v]).array() - spare).matrix();
    high_[v] = (start_[v].cwiseMax(end_[v]).array() + spare).matrix();
  });
  std::erase_if(pairs_, [&](const Watched& watched) { return any_of(vertices, watched.pair); });
  const auto add = [&](const FeaturePair& pair) {
    if (any_of(vertices, pair))
      pairs_.push_back({pair, -std::numeric_limits<double>::infinity()});
  };
  for (const Candidates& part : tree_.candidates({low_, high_, reach_}, nearest_part, false, vertices)) {
    for (const auto& [v, t] : part.on_way.vertex_triangle)
      add(vertex_triangle(mesh_, v, t));
    for (const auto& [e, f] : part.on_way.edge_edge)
      add(edge_edge(mesh_, e, f));
  }
}

std::optional<Hit> PairWatch::look_at(Watched& watched) const {
  const Ways ways{start_, end_, reach_};
  double gone = 0;
  for (const std::uint32_t v : watched.pair.vertices)
    gone += gone_[v];
  if (gone < watched.apart_until)
    return std::nullopt;
  const auto [hit, room] = hit_or_room(watched.pair, ways);
  watched.apart_until = gone + room;
  return hit;
}

} // namespace sheet::collide
