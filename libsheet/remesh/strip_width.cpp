// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/strip_width.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "libsheet/flow/strand_width.h"

namespace sheet::remesh {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double sharp_corner = std::numbers::pi / 3;
constexpr double wedge_part = 0.25; // of how fast a wedge opens: what opens less is a strip

// The side of a triangle that alone lies on a rim; no_index if there is none.
std::uint32_t rim_side(const Mesh& mesh, std::uint32_t t) {
  std::uint32_t found = no_index;
  for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side)
    if (mesh.twin(side) == no_index) {
      if (found != no_index)
        return no_index;
      found = side;
    }
  return found;
}

// Across a vertex between two rows of triangles (strand_width.h).
double width_at(const EditableSheet& sheet, std::uint32_t v, std::vector<Vector3>& ways) {
  const Mesh& mesh = sheet.mesh();
  ways.clear();
  mesh.for_fan(v, [&](std::uint32_t side) {
    if (mesh.twin(Mesh::next(side)) == no_index)
      ways.push_back(flow::way_to_line(sheet.at(v), sheet.at(mesh.to(side)), sheet.at(mesh.apex(side))));
  });
  return flow::width_across(ways);
}

// The sheet's own angle at a vertex of a rim [rad].
double angle_at(const EditableSheet& sheet, std::uint32_t v) {
  double sum = 0;
  sheet.mesh().for_fan(v, [&](std::uint32_t side) {
    const Vector3 a = sheet.at(sheet.mesh().to(side)) - sheet.at(v),
                  b = sheet.at(sheet.mesh().apex(side)) - sheet.at(v);
    sum += std::atan2(a.cross(b).norm(), a.dot(b));
  });
  return sum;
}

// From the tip on, as long as the strip is a part as wide as the wedge of this angle or wider, so far along the sheet
// [Dijkstra 1959]: another strand that passes the tip has nothing to do with it.
void leave_out_wedge(const EditableSheet& sheet, std::uint32_t tip, double angle, std::vector<double>& width) {
  using Entry = std::pair<double, std::uint32_t>;
  const double opening = wedge_part * 2 * std::tan(angle / 2);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> reached;
  const auto leave_out = [&](std::uint32_t v, double way) {
    width[v] = infinity;
    sheet.mesh().for_neighbours(v,
                                [&](std::uint32_t w) { reached.emplace(way + (sheet.at(w) - sheet.at(v)).norm(), w); });
  };
  leave_out(tip, 0);
  while (!reached.empty()) {
    const auto [way, v] = reached.top();
    reached.pop();
    if (!std::isinf(width[v]) && width[v] >= opening * way)
      leave_out(v, way);
  }
}

} // namespace

std::vector<double> strip_widths(const EditableSheet& sheet, double least_wedge) {
  const Mesh& mesh = sheet.mesh();
  std::vector<double> width(mesh.vertex_slots(), infinity);
  std::vector<Vector3> ways;
  bool any = false;
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t) {
    const std::uint32_t side = rim_side(mesh, t);
    if (side == no_index)
      continue;
    const std::uint32_t apex = mesh.apex(side);
    const double across = mesh.on_rim(apex)
                              ? 2 * sheet.shape(t).area / (sheet.at(mesh.to(side)) - sheet.at(mesh.from(side))).norm()
                              : width_at(sheet, apex, ways);
    for (const std::uint32_t v : mesh.corners(t))
      width[v] = std::min(width[v], across);
    any = any || across < infinity;
  }
  for (std::uint32_t v = 0; any && v < width.size(); ++v)
    if (mesh.on_rim(v))
      if (const double angle = angle_at(sheet, v); angle < sharp_corner && angle >= least_wedge)
        leave_out_wedge(sheet, v, angle, width);
  return width;
}

} // namespace sheet::remesh
