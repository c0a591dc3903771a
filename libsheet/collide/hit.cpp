// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/hit.h"

#include <algorithm>
#include <cmath>

namespace sheet::collide {

namespace {

constexpr double kept_part = 0.5; // of the distance at the start

SweptPair swept(const FeaturePair& pair, const Ways& ways) {
  const auto& v = pair.vertices;
  return {pair.features,
          {ways.start[v[0]], ways.start[v[1]], ways.start[v[2]], ways.start[v[3]]},
          {ways.end[v[0]], ways.end[v[1]], ways.end[v[2]], ways.end[v[3]]}};
}

// Distance that is too near [m]: as if the closest points were in the middle of the features.
double too_near(const FeaturePair& pair, const Ways& ways) {
  constexpr std::array<double, 4> of_vertex = {1, 1.0 / 3, 1.0 / 3, 1.0 / 3}, of_edges = {0.5, 0.5, 0.5, 0.5};
  const auto& weights = pair.features == Features::vertex_triangle ? of_vertex : of_edges;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    sum += weights[i] * ways.reach[pair.vertices[i]];
  return nearest_part * (0.5 * sum);
}

} // namespace

ClosestPoints closest_points(Features features, const std::array<Vector3, 4>& x) {
  return features == Features::vertex_triangle ? closest_vertex_triangle(x) : closest_edge_edge(x);
}

bool boxes_overlap(const FeaturePair& pair, const Ways& ways, double part) {
  const std::size_t first = pair.features == Features::vertex_triangle ? 1 : 2;
  const std::span<const std::uint32_t> v = pair.vertices;
  return ways.way(v.first(first)).box(part).overlaps(ways.way(v.subspan(first)).box(part));
}

HitOrRoom hit_or_room(const FeaturePair& pair, const Ways& ways) {
  const SweptPair way = swept(pair, ways);
  const double wanted = too_near(pair, ways);
  if (const double room = sure_room(way, wanted); room > 0)
    return {std::nullopt, room};
  const Vector3 offset = closest_points(pair.features, way.start).offset;
  const double distance = offset.norm(), gap = std::min(wanted, kept_part * distance);
  const auto [time, room] =
      contact_or_room(way, {.gap = gap, .time_tolerance = 1e-4, .budget = 1024, .towards = offset});
  if (time)
    return {Hit{pair, *time, gap, distance}, 0};
  return {std::nullopt, room};
}

} // namespace sheet::collide
