// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/capped_volume.h"

#include <map>

#include "libsheet/geometry/disjoint_sets.h"

namespace sheet {

namespace {

struct Rim {
  Vector3 sum = Vector3::Zero();
  std::size_t count = 0;
};

} // namespace

double capped_volume(const Connectivity& mesh, std::span<const Vector3> positions, std::span<const char> part) {
  Vector3 origin = Vector3::Zero();
  for (const Vector3& x : positions)
    origin += x / static_cast<double>(positions.size());
  const auto cone = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    return (a - origin).dot((b - origin).cross(c - origin)) / 6;
  };
  const auto counts = [&](std::size_t triangle) { return part.empty() || part[triangle] != 0; };
  const auto on_rim = [&](std::size_t e) {
    const auto [first, second] = mesh.edge_triangles[e];
    return mesh.on_rim(e) && counts(first != no_index ? first : second);
  };
  double volume = 0;
  DisjointSets sets(mesh.vertices);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (const Corners& t = mesh.triangles[i]; counts(i))
      volume += cone(positions[t[0]], positions[t[1]], positions[t[2]]);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (on_rim(e))
      sets.join(mesh.edges[e][0], mesh.edges[e][1]);
  std::map<std::uint64_t, Rim> rims;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (on_rim(e)) {
      Rim& rim = rims[sets.find(mesh.edges[e][0])];
      rim.sum += positions[mesh.edges[e][0]] + positions[mesh.edges[e][1]]; // each vertex twice
      rim.count += 2;
    }
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (on_rim(e)) {
      const Rim& rim = rims[sets.find(mesh.edges[e][0])];
      const Vector3 middle = rim.sum / static_cast<double>(rim.count);
      const bool forward = mesh.edge_triangles[e][0] != no_index; // the triangle runs from the lower to the higher
      const Vector3 &a = positions[mesh.edges[e][0]], &b = positions[mesh.edges[e][1]];
      volume += forward ? cone(b, a, middle) : cone(a, b, middle);
    }
  return volume;
}

} // namespace sheet
