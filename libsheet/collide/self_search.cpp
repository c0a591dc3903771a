// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/self_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/geometry/triangle_pair.h"

namespace sheet::collide {

namespace {

// Of the contact distance: nearer than this is too near, whatever the distance at the start.
constexpr double nearest_part = 0.1;
// Of the distance at the start.
constexpr double kept_part = 0.5;
// Cosine between a triangle's normal and the way to a vertex beside it that still counts as a contact of surfaces.
constexpr double facing = 0.5;

using Four = std::array<std::uint32_t, 4>;

std::array<Vector3, 4> points(std::span<const Vector3> x, const Four& v) {
  return {x[v[0]], x[v[1]], x[v[2]], x[v[3]]};
}

ClosestPoints closest(Features features, const std::array<Vector3, 4>& x) {
  return features == Features::vertex_triangle ? closest_vertex_triangle(x) : closest_edge_edge(x);
}

// Contact distance of a pair whose closest points have these weights.
double contact_distance(std::span<const double> reach, const Four& v, const std::array<double, 4>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += std::abs(weights[i]) * reach[v[i]];
  return 0.5 * sum;
}

constexpr std::array<double, 4> even_weights(Features features) {
  return features == Features::vertex_triangle ? std::array{1.0, -1.0 / 3, -1.0 / 3, -1.0 / 3}
                                               : std::array{0.5, 0.5, -0.5, -0.5};
}

std::optional<Hit> hit_of(const FeaturePair& pair, std::span<const Vector3> start, std::span<const Vector3> end,
                          std::span<const double> reach) {
  const SweptPair swept{pair.features, points(start, pair.vertices), points(end, pair.vertices)};
  const double wanted = nearest_part * contact_distance(reach, pair.vertices, even_weights(pair.features));
  if (surely_apart(swept, wanted))
    return std::nullopt;
  const double distance = closest(pair.features, swept.start).offset.norm();
  const double gap = std::min(wanted, kept_part * distance);
  const auto time = first_contact(swept, {.gap = gap, .time_tolerance = 1e-4, .budget = 1024});
  if (!time)
    return std::nullopt;
  return Hit{pair, *time, gap, distance};
}

// work(i) for i < count, on all threads.
template <class Work> void in_parallel(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      work(i);
  });
}

// What work(i, out) appends to `out` for i < count goes to the end of `all`, in the order of i.
template <class Found, class Work> void in_chunks(std::size_t count, std::vector<Found>& all, const Work& work) {
  constexpr std::size_t chunk = 2048;
  std::vector<std::vector<Found>> found((count + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t k) {
    for (std::size_t i = k * chunk; i < std::min((k + 1) * chunk, count); ++i)
      work(i, found[k]);
  });
  for (const auto& part : found)
    all.insert(all.end(), part.begin(), part.end());
}

} // namespace

SelfSearch::SelfSearch(const Connectivity& mesh) : mesh_(mesh), layers_(mesh) {
  std::vector<std::uint8_t> vertex(mesh.vertices, false), edge(mesh.edges.size(), false);
  const auto begin = [&] {
    own_begin_.push_back(
        {static_cast<std::uint32_t>(own_vertices_.size()), static_cast<std::uint32_t>(own_edges_.size())});
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    begin();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i], e = mesh.triangle_edges[t][i];
      if (!std::exchange(vertex[v], true))
        own_vertices_.push_back({{}, v, {v, v}});
      if (!std::exchange(edge[e], true))
        own_edges_.push_back({{}, e, mesh.edges[e]});
    }
  }
  begin();
}

// The boxes of features on their ways, grown by half of a part of their contact distance.
void SelfSearch::place_boxes(Positions start, Positions end, std::span<const double> reach, double part) {
  vertex_boxes_.resize(mesh_.vertices);
  edge_boxes_.resize(mesh_.edges.size());
  boxes_.resize(mesh_.triangles.size());
  const auto place = [&](std::span<const std::uint32_t> vertices) {
    double most = 0;
    for (const std::uint32_t v : vertices)
      most = std::max(most, reach[v]);
    Box box;
    for (const std::uint32_t v : vertices) {
      box.add(start[v], 0.5 * part * most);
      box.add(end[v], 0.5 * part * most);
    }
    return box;
  };
  in_parallel(vertex_boxes_.size(), [&](std::size_t v) {
    const auto vertex = static_cast<std::uint32_t>(v);
    vertex_boxes_[v] = place({&vertex, 1});
  });
  in_parallel(edge_boxes_.size(), [&](std::size_t e) { edge_boxes_[e] = place(mesh_.edges[e]); });
  in_parallel(boxes_.size(), [&](std::size_t t) { boxes_[t] = place(mesh_.triangles[t]); });
}

// Sorts the tree once; where it is sorted, the boxes may have moved since, which costs speed only.
void SelfSearch::place_tree() {
  if (tree_.size() == boxes_.size())
    tree_.refit(boxes_);
  else
    tree_.build(boxes_);
}

// The vertices that are not where the candidates were gathered, or reach farther.
SelfSearch::Flags SelfSearch::outside(Positions start, Positions end, std::span<const double> reach) const {
  Flags flags(mesh_.vertices, 1);
  if (!around_.empty())
    in_parallel(flags.size(), [&](std::size_t v) {
      flags[v] = !around_[v].holds(start[v]) || !around_[v].holds(end[v]) || !(reach[v] <= reach_[v]);
    });
  return flags;
}

SelfSearch::Flags SelfSearch::triangles_with(std::span<const std::uint8_t> vertices) const {
  Flags flags(mesh_.triangles.size());
  for (std::size_t t = 0; t < flags.size(); ++t) {
    const Corners& c = mesh_.triangles[t];
    flags[t] = vertices[c[0]] | vertices[c[1]] | vertices[c[2]];
  }
  return flags;
}

SelfSearch::Candidates SelfSearch::overlapping(std::span<const std::uint8_t> chosen) {
  std::vector<QuickBox> quick(boxes_.size());
  in_parallel(quick.size(), [&](std::size_t t) { quick[t] = QuickBox(boxes_[t]); });
  in_parallel(own_vertices_.size(),
              [&](std::size_t i) { own_vertices_[i].box = QuickBox(vertex_boxes_[own_vertices_[i].index]); });
  in_parallel(own_edges_.size(),
              [&](std::size_t i) { own_edges_[i].box = QuickBox(edge_boxes_[own_edges_[i].index]); });
  std::vector<Candidates> found(tree_.chunks());
  const auto vertex_triangle = [&](Candidates& out, std::uint32_t s, std::uint32_t t) {
    const Corners& c = mesh_.triangles[t];
    for (std::uint32_t i = own_begin_[s][0]; i < own_begin_[s + 1][0]; ++i)
      if (const Owned& v = own_vertices_[i];
          v.box.may_overlap(quick[t]) && v.index != c[0] && v.index != c[1] && v.index != c[2])
        out.vertex_triangle.push_back({v.index, t});
  };
  tree_.for_overlaps(chosen, [&](std::size_t chunk, std::uint32_t s, std::uint32_t t) {
    Candidates& out = found[chunk];
    vertex_triangle(out, s, t);
    vertex_triangle(out, t, s);
    for (std::uint32_t i = own_begin_[s][1]; i < own_begin_[s + 1][1]; ++i)
      for (std::uint32_t j = own_begin_[t][1]; j < own_begin_[t + 1][1]; ++j) {
        const Owned &e = own_edges_[i], &f = own_edges_[j];
        const auto& [a, b] = e.ends;
        const auto& [c, d] = f.ends;
        const bool joined = static_cast<int>(a == c) + (a == d) + (b == c) + (b == d) != 0;
        if (!joined && e.box.may_overlap(f.box))
          out.edge_edge.push_back({std::min(e.index, f.index), std::max(e.index, f.index)});
      }
  });
  Candidates all;
  for (const Candidates& part : found) {
    all.vertex_triangle.insert(all.vertex_triangle.end(), part.vertex_triangle.begin(), part.vertex_triangle.end());
    all.edge_edge.insert(all.edge_edge.end(), part.edge_edge.begin(), part.edge_edge.end());
  }
  return all;
}

void SelfSearch::gather(Positions start, Positions end, std::span<const double> reach) {
  const Flags flags = outside(start, end, reach);
  if (4 * std::count(flags.begin(), flags.end(), 1) <= static_cast<std::ptrdiff_t>(flags.size()))
    return; // few pairs to be looked up
  around_.assign(mesh_.vertices, {});
  for (std::size_t v = 0; v < around_.size(); ++v) {
    around_[v].add(start[v], 0);
    around_[v].add(end[v], 0);
  }
  reach_.assign(reach.begin(), reach.end());
  place_boxes(start, end, reach, 1);
  place_tree();
  candidates_ = overlapping({});
}

// What the test finds in pairs of features whose boxes overlap: in those with a vertex that has a flag, through the
// tree; in the others too, among the candidates, unless only those with a flag are wanted.
template <class Found, class Test>
std::vector<Found> SelfSearch::collect(std::span<const std::uint8_t> flags, bool flagged_only, const Test& test) {
  const auto flagged = [&](const Four& v) { return (flags[v[0]] | flags[v[1]] | flags[v[2]] | flags[v[3]]) != 0; };
  std::vector<Found> all;
  const auto look_at = [&](const Candidates& candidates, bool with_flag) {
    const std::size_t count = candidates.vertex_triangle.size();
    const auto pair_of = [&](std::size_t i) -> std::optional<FeaturePair> {
      if (i < count) {
        const auto& [v, t] = candidates.vertex_triangle[i];
        const Corners& c = mesh_.triangles[t];
        return vertex_boxes_[v].overlaps(boxes_[t])
                   ? std::optional(FeaturePair{Features::vertex_triangle, {v, c[0], c[1], c[2]}})
                   : std::nullopt;
      }
      const auto& [e, f] = candidates.edge_edge[i - count];
      const Edge &a = mesh_.edges[e], &b = mesh_.edges[f];
      return edge_boxes_[e].overlaps(edge_boxes_[f])
                 ? std::optional(FeaturePair{Features::edge_edge, {a[0], a[1], b[0], b[1]}})
                 : std::nullopt;
    };
    in_chunks(count + candidates.edge_edge.size(), all, [&](std::size_t i, std::vector<Found>& out) {
      const auto pair = pair_of(i);
      if (pair && flagged(pair->vertices) == with_flag)
        test(*pair, out);
    });
  };
  if (!flagged_only)
    look_at(candidates_, false);
  if (std::find(flags.begin(), flags.end(), 1) != flags.end()) {
    place_tree();
    look_at(overlapping(triangles_with(flags)), true);
  }
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.pair < b.pair; });
  return all;
}

std::vector<Hit> SelfSearch::hits(Positions start, Positions end, std::span<const double> reach,
                                  std::span<const std::uint8_t> moved) {
  const auto test = [&](const FeaturePair& pair, std::vector<Hit>& out) {
    if (const auto hit = hit_of(pair, start, end, reach))
      out.push_back(*hit);
  };
  if (moved.empty())
    gather(start, end, reach);
  place_boxes(start, end, reach, nearest_part);
  return moved.empty() ? collect<Hit>(outside(start, end, reach), false, test) : collect<Hit>(moved, true, test);
}

std::vector<NearPair> SelfSearch::near(Positions x, std::span<const double> reach) {
  gather(x, x, reach);
  place_boxes(x, x, reach, 1);
  const auto joined = [&](std::uint32_t a, std::uint32_t b) {
    return std::binary_search(mesh_.edges.begin(), mesh_.edges.end(), Edge{std::min(a, b), std::max(a, b)});
  };
  const auto joins = [&](const Four& v, std::size_t first) {
    for (std::size_t i = 0; i < first; ++i)
      for (std::size_t j = first; j < 4; ++j)
        if (joined(v[i], v[j]))
          return true;
    return false;
  };
  const auto touching = [&](const FeaturePair& pair) -> std::optional<ClosestPoints> {
    const Four& v = pair.vertices;
    const std::array<Vector3, 4> p = points(x, v);
    if (pair.features == Features::edge_edge) {
      const auto crossing = crossing_edges(p);
      return crossing && !joins(v, 2) ? crossing : std::nullopt;
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
    return height > facing * closest.offset.norm() && !joins(v, 1) ? std::optional(closest) : std::nullopt;
  };
  return collect<NearPair>(outside(x, x, reach), false, [&](const FeaturePair& pair, std::vector<NearPair>& out) {
    const auto closest = touching(pair);
    if (!closest)
      return;
    const double distance = closest->offset.norm();
    if (distance > 0 && distance < contact_distance(reach, pair.vertices, closest->weights))
      out.push_back({pair, *closest});
  });
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> SelfSearch::crossing(Positions x,
                                                                            std::span<const std::uint8_t> chosen) {
  boxes_.assign(mesh_.triangles.size(), {});
  Flags degenerate(boxes_.size());
  in_parallel(boxes_.size(), [&](std::size_t t) {
    for (const std::uint32_t v : mesh_.triangles[t])
      boxes_[t].add(x[v], 0);
    degenerate[t] = corners_collinear(x, mesh_.triangles[t]);
  });
  place_tree();
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(tree_.chunks());
  tree_.for_overlaps(chosen, [&](std::size_t chunk, std::uint32_t s, std::uint32_t t) {
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
