// SPDX-License-Identifier: GPL-3.0-or-later
// Two features of a sheet that come too near to each other within a step: nearer than a tenth of their contact
// distance, or than half the distance that they start with, if that is less. So what is apart at the start and no hit
// is apart all the time, and two that are pressed together lose distance slowly.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "libsheet/collide/feature_tree.h"
#include "libsheet/collide/swept_pair.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/connectivity.h"

namespace sheet::collide {

// Of the contact distance: nearer than this is too near, whatever the distance at the start.
inline constexpr double nearest_part = 0.1;

// Vertex, then triangle; or edge, then edge.
struct FeaturePair {
  Features features = Features::vertex_triangle;
  std::array<std::uint32_t, 4> vertices{};
  auto operator<=>(const FeaturePair&) const = default;
};

[[nodiscard]] inline FeaturePair vertex_triangle(const Connectivity& mesh, std::uint32_t vertex,
                                                 std::uint32_t triangle) {
  const Corners& c = mesh.triangles[triangle];
  return {Features::vertex_triangle, {vertex, c[0], c[1], c[2]}};
}
[[nodiscard]] inline FeaturePair edge_edge(const Connectivity& mesh, std::uint32_t first, std::uint32_t second) {
  const Edge &a = mesh.edges[first], &b = mesh.edges[second];
  return {Features::edge_edge, {a[0], a[1], b[0], b[1]}};
}

// The pair comes nearer than `gap` [m] soon after `time` (0 start, 1 end of the step); `distance` [m]: at the start.
struct Hit {
  FeaturePair pair;
  double time = 0, gap = 0, distance = 0;
};

[[nodiscard]] ClosestPoints closest_points(Features features, const std::array<Vector3, 4>& x);

// Whether the boxes of the features on their ways overlap, grown by half of a part of their reach; if not, with
// `nearest_part`, the pair is no hit.
[[nodiscard]] bool boxes_overlap(const FeaturePair& pair, const Ways& ways, double part);

// A hit, or the room that the features keep between them all the way beyond what is too near, at least [m]: none of
// their vertices' ends make a hit of them that together are less far from those given. 0: not known.
struct HitOrRoom {
  std::optional<Hit> hit;
  double room = 0;
};
[[nodiscard]] HitOrRoom hit_or_room(const FeaturePair& pair, const Ways& ways);

} // namespace sheet::collide
