// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/strip_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sheet::remesh {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double sharp_corner = std::numbers::pi / 3;
constexpr double wedge_part = 0.25; // of how fast a wedge opens: what opens less is a strip

// The side on a rim of a triangle that reaches from rim to rim; no_index if it does not.
std::uint32_t spanned_side(const Mesh& mesh, std::uint32_t t) {
  std::uint32_t found = no_index;
  for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side)
    if (mesh.twin(side) == no_index) {
      if (found != no_index)
        return no_index;
      found = side;
    }
  return found != no_index && mesh.on_rim(mesh.apex(found)) ? found : no_index;
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

// From the tip on, as long as the strip is a part as wide as the wedge of this angle or wider.
void leave_out_wedge(const EditableSheet& sheet, std::uint32_t tip, double angle, std::vector<double>& width) {
  const double opening = 2 * std::tan(angle / 2);
  std::vector<std::uint32_t> reached = {tip};
  while (!reached.empty()) {
    const std::uint32_t v = reached.back();
    reached.pop_back();
    sheet.mesh().for_neighbours(v, [&](std::uint32_t w) {
      if (std::isinf(width[w]) || width[w] < wedge_part * opening * (sheet.at(w) - sheet.at(tip)).norm())
        return;
      width[w] = infinity;
      reached.push_back(w);
    });
  }
}

} // namespace

std::vector<double> strip_widths(const EditableSheet& sheet, double least_wedge) {
  const Mesh& mesh = sheet.mesh();
  std::vector<double> width(mesh.vertex_slots(), infinity);
  bool any = false;
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t) {
    const std::uint32_t side = spanned_side(mesh, t);
    if (side == no_index)
      continue;
    const double height = 2 * sheet.shape(t).area / (sheet.at(mesh.to(side)) - sheet.at(mesh.from(side))).norm();
    for (const std::uint32_t v : mesh.corners(t))
      width[v] = std::min(width[v], height);
    any = true;
  }
  for (std::uint32_t v = 0; any && v < width.size(); ++v)
    if (mesh.on_rim(v))
      if (const double angle = angle_at(sheet, v); angle < sharp_corner && angle >= least_wedge)
        leave_out_wedge(sheet, v, angle, width);
  return width;
}

} // namespace sheet::remesh
