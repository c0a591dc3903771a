// SPDX-License-Identifier: GPL-3.0-or-later
// What liquid does that flows along solids, by order of magnitude, for explain.cpp: a layer of thickness h and length L
// on the steepest of them, under its weight [Huppert 1982].
#pragma once
#include <optional>

#include "libsheet/scene/scales.h"

namespace sheet::scene {

struct LayerScales {
  double along = 0;            // g_t: gravity along the solid, under the sheet where that is known [m/s²]
  double stress = 0;           // of its weight at the wall, rho h (g_t + g h/L) [Pa]
  double speed = 0;            // stress (h + 3 b)/(3 mu) [m/s]; in general that of wall_flow.h, 0 below a yield stress
  double viscosity = 0;        // at the rate U/h [Pa s]
  double time = 0;             // to spread by L [s]
  double reynolds = 0;         // U h²/(nu L): how far inertia delays the drag
  double capillary_length = 0; // sqrt(gamma/(rho g)): below it tension levels, above it weight; 0 without tension [m]
};

// In the mean over a layer of thickness h and slip length b [m], under a stress at its wall [Pa]: [m/s]; 0 of what
// stands there.
[[nodiscard]] double speed_of_layer(const Liquid& liquid, double stress, double h, double b);

// How thick a layer is that carries this flux [m²/s] down a wall along which gravity pulls with `along` [m/s²], at
// least `least` [m]: (3 nu q/g_t)^(1/3) of a Newtonian liquid without slip [Nusselt 1916].
[[nodiscard]] double thickness_of_layer(const Liquid& liquid, double along, double flux, double b, double least);

// Nothing without such a solid, liquid that does not slip freely, gravity, length and thickness.
[[nodiscard]] std::optional<LayerScales> layer_scales_of(const Scene& scene, const Scales& scales);

} // namespace sheet::scene
