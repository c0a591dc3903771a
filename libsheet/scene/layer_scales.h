// SPDX-License-Identifier: GPL-3.0-or-later
// What liquid does that flows along solids, by order of magnitude, for explain.cpp: a layer of thickness h and length L
// on the steepest of them, under its weight [Huppert 1982].
#pragma once
#include <optional>

#include "libsheet/scene/scales.h"

namespace sheet::scene {

struct LayerScales {
  double speed = 0;            // rho h (h + 3 b) (g_t + g h/L)/(3 mu), g_t gravity along the solid [m/s]
  double time = 0;             // to spread by L [s]
  double reynolds = 0;         // U h²/(nu L): how far inertia delays the drag
  double capillary_length = 0; // sqrt(gamma/(rho g)): below it tension levels, above it weight; 0 without tension [m]
};

// Nothing without such a solid, liquid that does not slip freely, gravity, length and thickness.
[[nodiscard]] std::optional<LayerScales> layer_scales_of(const Scene& scene, const Scales& scales);

} // namespace sheet::scene
