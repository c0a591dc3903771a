// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/lift.h"

#include <algorithm>

#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/triangle_grid.h"
#include "libsheet/geometry/triangle_pair.h"

namespace sheet::flow {

namespace {

// The triangles that stay and have an area, on their ways.
TriangleGrid grid_of(const Connectivity& mesh, const std::vector<bool>& taken, std::span<const Vector3> x,
                     std::span<const Vector3> end) {
  double sizes = 0;
  for (const Corners& t : mesh.triangles)
    sizes += box_of(x, t).half_size();
  TriangleGrid grid(2 * sizes / static_cast<double>(mesh.triangles.size()), mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!taken[t] && !corners_collinear(x, mesh.triangles[t]) && !corners_collinear(end, mesh.triangles[t])) {
      Box box = box_of(x, mesh.triangles[t]);
      box.add(box_of(end, mesh.triangles[t]));
      grid.add(t, box);
    }
  return grid;
}

// Whether a corner of one triangle is above the other one at first and below it at the end.
bool passes(std::span<const Vector3> x, std::span<const Vector3> end, const Corners& one, const Corners& other) {
  return std::ranges::any_of(one, [&](std::uint32_t v) {
    if (std::ranges::find(other, v) != other.end())
      return false;
    const auto above = over_triangle({x[v], x[other[0]], x[other[1]], x[other[2]]});
    const auto then = over_triangle({end[v], end[other[0]], end[other[1]], end[other[2]]});
    return above && then && above->offset.dot(then->offset) <= 0;
  });
}

} // namespace

std::size_t keep_clear(const Connectivity& mesh, const std::vector<bool>& taken, std::span<const Vector3> x,
                       std::span<const ContactSpring> welds, std::vector<Vector3>& ways) {
  std::size_t staying = 0;
  const auto moves = [&](std::uint32_t v) { return !ways[v].isZero(0); };
  for (;;) {
    std::vector<Vector3> end(x.begin(), x.end());
    for (std::size_t v = 0; v < end.size(); ++v)
      end[v] += ways[v];
    std::vector<bool> blocked(end.size(), false);
    for (const ContactSpring& s : welds)
      if (s.normal.dot(s.offset(end)) < 0.5 * s.normal.dot(s.offset(x)))
        for (const std::uint32_t v : s.vertices)
          blocked[v] = true;
    const TriangleGrid grid = grid_of(mesh, taken, x, end);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (const Corners& own = mesh.triangles[t]; grid.has(t) && std::ranges::any_of(own, moves))
        grid.for_meeting(grid.box_of(t), [&](std::uint32_t other) {
          const Corners& its = mesh.triangles[other];
          if (other != t &&
              (triangles_intersect(end, own, its) || passes(x, end, own, its) || passes(x, end, its, own)))
            for (const Corners& c : {own, its})
              for (const std::uint32_t v : c)
                blocked[v] = true;
        });
    const std::size_t before = staying;
    for (std::uint32_t v = 0; v < ways.size(); ++v)
      if (blocked[v] && moves(v)) {
        ways[v].setZero();
        ++staying;
      }
    if (staying == before)
      return staying;
  }
}

} // namespace sheet::flow
