// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/body_surface.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "libsheet/geometry/disjoint_sets.h"

namespace sheet::solid {
namespace {

double enclosed_volume(const SolidSurface& surface) {
  double six_volumes = 0;
  for (const Corners& c : surface.triangles)
    six_volumes += surface.points[c[0]].dot(surface.points[c[1]].cross(surface.points[c[2]]));
  return six_volumes / 6;
}

} // namespace

double inflate_to(double volume, double farthest, SolidSurface& surface) {
  std::vector<Vector3> normals(surface.points.size(), Vector3::Zero()); // first the volume's gradients
  for (const Corners& c : surface.triangles) {
    const Vector3& x = surface.points[c[0]];
    const Vector3 share = (surface.points[c[1]] - x).cross(surface.points[c[2]] - x) / 6;
    for (const std::uint32_t v : c)
      normals[v] += share;
  }
  double area = 0;
  for (Vector3& normal : normals) {
    const double length = normal.norm();
    area += length;
    if (length > 0)
      normal /= length;
  }
  double way = 0;
  for (int round = 0; round < 3 && area > 0; ++round) { // Newton's, with the first slope
    const double more = std::clamp((volume - enclosed_volume(surface)) / area, -farthest - way, farthest - way);
    for (std::size_t v = 0; v < normals.size(); ++v)
      surface.points[v] += more * normals[v];
    way += more;
  }
  return way;
}

void drop_parts(const std::function<bool(const Vector3&)>& is_out, SolidSurface& surface) {
  DisjointSets parts(surface.points.size());
  for (const Corners& c : surface.triangles) {
    parts.join(c[0], c[1]);
    parts.join(c[0], c[2]);
  }
  std::vector<std::int64_t> votes(surface.points.size(), 0); // at the part's first point
  for (std::uint32_t v = 0; v < surface.points.size(); ++v)
    votes[parts.find(v)] += is_out(surface.points[v]) ? 1 : -1;
  std::vector<std::uint32_t> numbers(surface.points.size(), no_index);
  SolidSurface kept;
  for (std::uint32_t v = 0; v < surface.points.size(); ++v)
    if (votes[parts.find(v)] <= 0) {
      numbers[v] = static_cast<std::uint32_t>(kept.points.size());
      kept.points.push_back(surface.points[v]);
    }
  for (const Corners& c : surface.triangles)
    if (numbers[c[0]] != no_index)
      kept.triangles.push_back({numbers[c[0]], numbers[c[1]], numbers[c[2]]});
  surface = std::move(kept);
}

} // namespace sheet::solid
