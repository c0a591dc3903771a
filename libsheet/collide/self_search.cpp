// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/self_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

} // namespace

SelfSearch::SelfSearch(const Connectivity& mesh) : mesh_(mesh), owned_(mesh.triangles.size(), 0) {
  std::vector<std::uint8_t> vertex(mesh.vertices, false), edge(mesh.edges.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::exchange(vertex[mesh.triangles[t][i]], true))
        owned_[t] |= static_cast<std::uint8_t>(1U << i);
      if (!std::exchange(edge[mesh.triangle_edges[t][i]], true))
        owned_[t] |= static_cast<std::uint8_t>(8U << i);
    }
}

template <class Found, class Test>
std::vector<Found> SelfSearch::collect(std::span<const std::uint8_t> chosen, Test&& test) const {
  std::vector<std::vector<Found>> found(tree_.chunks());
  const auto vertex_triangle = [&](std::vector<Found>& out, std::uint32_t s, std::uint32_t t) {
    const Triangle& c = mesh_.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::uint32_t v = mesh_.triangles[s][i];
          (owned_[s] >> i & 1) != 0 && v != c[0] && v != c[1] && v != c[2] && vertex_boxes_[v].overlaps(boxes_[t]))
        test(FeaturePair{Features::vertex_triangle, {v, c[0], c[1], c[2]}}, out);
  };
  const auto edge_edge = [&](std::vector<Found>& out, std::uint32_t e, std::uint32_t f) {
    const Edge &a = mesh_.edges[std::min(e, f)], &b = mesh_.edges[std::max(e, f)];
    if (a[0] != b[0] && a[0] != b[1] && a[1] != b[0] && a[1] != b[1] && edge_boxes_[e].overlaps(edge_boxes_[f]))
      test(FeaturePair{Features::edge_edge, {a[0], a[1], b[0], b[1]}}, out);
  };
  tree_.for_overlaps(chosen, [&](std::size_t chunk, std::uint32_t s, std::uint32_t t) {
    std::vector<Found>& out = found[chunk];
    vertex_triangle(out, s, t);
    vertex_triangle(out, t, s);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if ((owned_[s] >> (3 + i) & 1) != 0 && (owned_[t] >> (3 + j) & 1) != 0)
          edge_edge(out, mesh_.triangle_edges[s][i], mesh_.triangle_edges[t][j]);
  });
  std::vector<Found> all;
  for (const auto& part : found)
    all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(), [](const Found& a, const Found& b) { return a.pair < b.pair; });
  return all;
}

void SelfSearch::place_boxes(std::span<const Vector3> start, std::span<const Vector3> end,
                             std::span<const double> reach, double part) {
  vertex_boxes_.assign(mesh_.vertices, {});
  edge_boxes_.assign(mesh_.edges.size(), {});
  boxes_.assign(mesh_.triangles.size(), {});
  const auto place = [&](Box& box, std::span<const std::uint32_t> vertices) {
    double most = 0;
    for (const std::uint32_t v : vertices)
      most = std::max(most, reach[v]);
    for (const std::uint32_t v : vertices) {
      box.add(start[v], 0.5 * part * most);
      box.add(end[v], 0.5 * part * most);
    }
  };
  for (std::uint32_t v = 0; v < vertex_boxes_.size(); ++v)
    place(vertex_boxes_[v], {&v, 1});
  for (std::size_t e = 0; e < edge_boxes_.size(); ++e)
    place(edge_boxes_[e], mesh_.edges[e]);
  for (std::size_t t = 0; t < boxes_.size(); ++t)
    place(boxes_[t], mesh_.triangles[t]);
}

std::vector<Hit> SelfSearch::hits(std::span<const Vector3> start, std::span<const Vector3> end,
                                  std::span<const double> reach, std::span<const std::uint8_t> moved) {
  place_boxes(start, end, reach, nearest_part);
  std::vector<std::uint8_t> chosen;
  if (moved.empty()) {
    tree_.build(boxes_);
  } else {
    tree_.refit(boxes_);
    for (const Triangle& c : mesh_.triangles)
      chosen.push_back(moved[c[0]] | moved[c[1]] | moved[c[2]]);
  }
  return collect<Hit>(chosen, [&](const FeaturePair& pair, std::vector<Hit>& out) {
    const Four& v = pair.vertices;
    if (!moved.empty() && (moved[v[0]] | moved[v[1]] | moved[v[2]] | moved[v[3]]) == 0)
      return;
    if (const auto hit = hit_of(pair, start, end, reach))
      out.push_back(*hit);
  });
}

std::vector<NearPair> SelfSearch::near(std::span<const Vector3> x, std::span<const double> reach) {
  place_boxes(x, x, reach, 1);
  if (tree_.size() == boxes_.size())
    tree_.refit(boxes_);
  else
    tree_.build(boxes_);
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
  return collect<NearPair>({}, [&](const FeaturePair& pair, std::vector<NearPair>& out) {
    const auto closest = touching(pair);
    if (!closest)
      return;
    const double distance = closest->offset.norm();
    if (distance > 0 && distance < contact_distance(reach, pair.vertices, closest->weights))
      out.push_back({pair, *closest});
  });
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> SelfSearch::crossing(std::span<const Vector3> x) {
  const std::vector<double> no_reach(mesh_.vertices, 0);
  place_boxes(x, x, no_reach, 0);
  tree_.build(boxes_);
  std::vector<std::uint8_t> degenerate;
  for (const Triangle& t : mesh_.triangles)
    degenerate.push_back(corners_collinear(x, t));
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(tree_.chunks());
  tree_.for_overlaps({}, [&](std::size_t chunk, std::uint32_t s, std::uint32_t t) {
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
