// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/strip_width.h"

#include <algorithm>
#include <limits>

namespace sheet::remesh {

namespace {

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

} // namespace

std::vector<double> strip_widths(const EditableSheet& sheet) {
  const Mesh& mesh = sheet.mesh();
  std::vector<double> width(mesh.vertex_slots(), std::numeric_limits<double>::infinity());
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t) {
    const std::uint32_t side = spanned_side(mesh, t);
    if (side == no_index)
      continue;
    const double height = 2 * sheet.shape(t).area / (sheet.at(mesh.to(side)) - sheet.at(mesh.from(side))).norm();
    for (const std::uint32_t v : mesh.corners(t))
      width[v] = std::min(width[v], height);
  }
  return width;
}

} // namespace sheet::remesh
