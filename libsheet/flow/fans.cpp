// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/fans.h"

#include "libsheet/geometry/disjoint_sets.h"

namespace sheet::flow {

Fans take_apart(const Connectivity& mesh, const std::vector<bool>& cut) {
  const auto corner_at = [&](std::uint32_t t, std::uint32_t v) -> std::uint64_t {
    const Corners& c = mesh.triangles[t];
    return 3 * std::uint64_t{t} + (c[0] == v ? 0 : c[1] == v ? 1 : 2);
  };
  DisjointSets sets(3 * mesh.triangles.size());
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    if (mesh.on_rim(e) || cut[e])
      continue;
    const auto [s, t] = mesh.edge_triangles[e];
    for (const std::uint32_t v : mesh.edges[e])
      sets.join(corner_at(s, v), corner_at(t, v));
  }
  const std::vector<std::uint64_t> first_corner = sets.take();
  Fans fans;
  fans.fan_count.assign(mesh.vertices, 0);
  for (std::uint32_t v = 0; v < mesh.vertices; ++v)
    fans.old_vertex.push_back(v);
  fans.triangles.resize(mesh.triangles.size());
  for (std::uint64_t corner = 0; corner < first_corner.size(); ++corner) {
    const std::uint32_t v = mesh.triangles[corner / 3][corner % 3];
    std::uint32_t& made = fans.triangles[corner / 3][corner % 3];
    if (const std::uint64_t first = first_corner[corner]; first != corner) {
      made = fans.triangles[first / 3][first % 3];
    } else if (fans.fan_count[v]++ == 0) {
      made = v;
    } else {
      made = static_cast<std::uint32_t>(fans.old_vertex.size());
      fans.old_vertex.push_back(v);
    }
  }
  return fans;
}

} // namespace sheet::flow
