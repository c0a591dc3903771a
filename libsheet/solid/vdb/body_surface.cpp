// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/body_surface.h"

#include <algorithm>
#include <cmath>
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

struct Part { // connected by triangles
  std::vector<Corners> triangles;
  double volume = 0, area = 0;
  bool dropped = false;
  [[nodiscard]] const Vector3& a_point(const SolidSurface& surface) const {
    return surface.points[triangles.front()[0]];
  }
};

std::vector<Part> parts_of(const SolidSurface& surface) {
  DisjointSets sets(surface.points.size());
  for (const Corners& c : surface.triangles) {
    sets.join(c[0], c[1]);
    sets.join(c[0], c[2]);
  }
  std::vector<Part> parts;
  std::vector<std::uint32_t> numbers(surface.points.size(), no_index); // of the part, at its first point
  for (const Corners& c : surface.triangles) {
    std::uint32_t& number = numbers[sets.find(c[0])];
    if (number == no_index) {
      number = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    Part& part = parts[number];
    const Vector3 &x = surface.points[c[0]], &y = surface.points[c[1]], &z = surface.points[c[2]];
    part.triangles.push_back(c);
    part.volume += x.dot(y.cross(z)) / 6;
    part.area += (y - x).cross(z - x).norm() / 2;
  }
  return parts;
}

// How often a part goes around a point: the sum of the solid angles of its triangles [van Oosterom, Strackee 1983].
double winding_number(const Part& part, const SolidSurface& surface, const Vector3& point) {
  double half_angles = 0;
  for (const Corners& c : part.triangles) {
    const Vector3 x = surface.points[c[0]] - point, y = surface.points[c[1]] - point, z = surface.points[c[2]] - point;
    const double a = x.norm(), b = y.norm(), d = z.norm();
    half_angles += std::atan2(x.dot(y.cross(z)), a * b * d + x.dot(y) * d + y.dot(z) * a + z.dot(x) * b);
  }
  return half_angles / two_pi;
}

// Leaves the parts that are not dropped, points in their order.
void keep(const std::vector<Part>& parts, SolidSurface& surface) {
  std::vector<char> used(surface.points.size(), 0);
  SolidSurface kept;
  for (const Part& part : parts)
    if (!part.dropped)
      for (const Corners& c : part.triangles) {
        kept.triangles.push_back(c);
        for (const std::uint32_t v : c)
          used[v] = 1;
      }
  std::vector<std::uint32_t> numbers(surface.points.size(), no_index);
  for (std::uint32_t v = 0; v < surface.points.size(); ++v)
    if (used[v] != 0) {
      numbers[v] = static_cast<std::uint32_t>(kept.points.size());
      kept.points.push_back(surface.points[v]);
    }
  for (Corners& c : kept.triangles)
    for (std::uint32_t& v : c)
      v = numbers[v];
  surface = std::move(kept);
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

Voids drop_voids(double wide, SolidSurface& surface) {
  std::vector<Part> parts = parts_of(surface);
  Voids found;
  for (Part& part : parts)
    if (part.volume < 0) {
      part.dropped = true;
      ++found.count;
      const bool is_air = -2 * part.volume > wide * part.area;
      double within = 0;
      for (Part& other : parts)
        if (other.volume > 0 && !other.dropped && winding_number(part, surface, other.a_point(surface)) < -0.5) {
          other.dropped = true;
          within += other.volume;
        }
      found.air += is_air ? -part.volume - within : 0;
    }
  if (found.count > 0)
    keep(parts, surface);
  return found;
}

} // namespace sheet::solid
