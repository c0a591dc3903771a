// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/bath_cover.h"

#include <algorithm>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {

BathCover::BathCover(const formats::Frame& frame, const Vector3& up, double level)
    : mesh_(connect(frame.vertices, triangles(frame))), positions_(positions(frame)), up_(up),
      flooded_(frame.vertices, 0) {
  const std::vector<double> thickness =
      thickness_around(frame.vertices, mesh_.triangles, volumes(frame), [&](std::uint32_t t) {
        const Corners& c = mesh_.triangles[t];
        return TriangleArea(positions_[c[0]], positions_[c[1]], positions_[c[2]]).area;
      });
  const auto deep = [&](std::uint32_t v) { return up_.dot(positions_[v]) - level < -thickness[v]; };
  DisjointSets pools(frame.vertices);
  std::vector<char> open(frame.vertices, 0); // of a pool, at its first vertex
  for (const auto& [a, b] : mesh_.edges)
    if (deep(a) && deep(b))
      pools.join(a, b);
  for (std::size_t e = 0; e < mesh_.edges.size(); ++e)
    if (mesh_.on_rim(e))
      for (const std::uint32_t v : mesh_.edges[e])
        if (deep(v))
          open[pools.find(v)] = 1;
  for (std::uint32_t v = 0; v < frame.vertices; ++v)
    flooded_[v] = open[pools.find(v)];
}

bool BathCover::under(const Vector3& x) const {
  return std::ranges::any_of(mesh_.triangles, [&](const Corners& c) {
    if (std::ranges::any_of(c, [&](auto v) { return flooded_[v] != 0; }))
      return false;
    const std::array<Vector3, 3> from{positions_[c[0]] - x, positions_[c[1]] - x, positions_[c[2]] - x};
    double whole = 0, height = 0; // the triangle's height over x, where it is above or below it, times its area
    std::array<double, 3> part{};
    for (std::size_t k = 0; k < 3; ++k) {
      part[k] = up_.dot(from[(k + 1) % 3].cross(from[(k + 2) % 3]));
      whole += part[k];
      height += part[k] * up_.dot(from[k]);
    }
    const auto [least, greatest] = std::ranges::minmax(part);
    return whole != 0 && least * greatest >= 0 && height / whole < 0;
  });
}

} // namespace sheet::collide
