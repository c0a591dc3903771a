// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/inlet_width.h"

#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

double width_of_inlet(const formats::Frame& first, std::size_t inflow) {
  const auto x = positions(first);
  const auto inlets = masks(first, "inlet");
  double width = 0;
  const Connectivity mesh = connect(first.vertices, triangles(first));
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    if (mesh.on_rim(e) && (of_inlet(inlets[a] & inlets[b], inflow) & at_inlet_border) != 0)
      width += (x[a] - x[b]).norm();
  }
  return width;
}

} // namespace sheet
