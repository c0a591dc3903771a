// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/layers.h"

#include "libsheet/energy/walls.h"
#include "libsheet/geometry/vertex_shares.h"

namespace sheet {

LayerShares layer_shares(const Stage& stage) {
  const auto& triangles = stage.start->mesh->triangles;
  LayerShares s;
  s.area = vertex_shares(stage.vertices(), triangles, [&](std::uint32_t t) { return stage.raised[t].area(); });
  s.thickness = stage.vertex_volumes;
  for (std::size_t v = 0; v < s.area.size(); ++v)
    s.thickness[v] /= s.area[v];
  return s;
}

LayerShear shear_on_wall(double lower, double upper, double slip_length) {
  if (slip_length == free_slip)
    return {1, (lower + upper) / 3};
  const double face = slip_length + lower / 2, mean = slip_length + lower / 3;
  return {face / mean, slip_length + lower + upper / 3 - face * face / mean};
}

LayerShear shear_in_stack(double lower, double upper) { return {1, (lower + upper) / 2}; }

} // namespace sheet
