// SPDX-License-Identifier: GPL-3.0-or-later
// What works on a triangle's area A alone: surface tension, the weight of layers on walls, the squeeze of layers, each
// absent unless asked for. Together
//   W = σ (A - A0) + T (1/A - 1/A0) - w ln(A/A0),
// A0 the flat triangle's area at the start of the step, which only keeps round-off small. Where edges are arcs A is
// that of the arcs (mid_edge_shell.h): the same area on which the viscous membrane acts, or one of the two would bend
// the directors of a flat film that the other does not hold. Else each is a term of its own.
#pragma once
#include <optional>

#include "libsheet/energy/contact_squeeze.h"
#include "libsheet/energy/surface_tension.h"
#include "libsheet/energy/wall_weight.h"

namespace sheet {

struct AreaLoads {
  std::optional<SurfaceTension> tension = {};
  std::optional<WallWeight> weight = {};
  std::optional<ContactSqueeze> squeeze = {};

  [[nodiscard]] bool any() const { return tension || weight || squeeze; }
  void begin(const Stage& stage) {
    if (tension)
      tension->begin(stage);
    if (weight)
      weight->begin(stage);
    if (squeeze)
      squeeze->begin(stage);
  }
};

} // namespace sheet
