// SPDX-License-Identifier: GPL-3.0-or-later
// The lengths, speeds and stresses by which a scene is judged, for explain.cpp.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libsheet/scene/explain.h"

namespace sheet::scene {

// Of one sheet.
struct Scales {
  std::optional<double> length;    // L [m]
  std::optional<double> thickness; // h [m]
  double curvature = 0;            // k, of the shape at the start [1/m]
  double gravity = 0;              // g [m/s²]
  double pressure = 0;             // |p|, where the scene states one [Pa]
  double speed = 0;                // V, the fastest that anything drives the sheet [m/s]
  std::string speed_source;
  std::vector<std::optional<double>> along; // gravity's part along each solid, or none, where the sheet lies [m/s²]
  bool lies = false;                        // on solids along which it flows, which carry its weight
  double above_bath = 0;                    // how far it falls to the bath [m]
  double viscosity = 0;                     // at the rate V/L; without length or speed that of the scene [Pa s]

  // Of the flow; nothing without length or speed [1/s].
  [[nodiscard]] std::optional<double> rate() const {
    return length && *length > 0 && speed > 0 ? std::optional(speed / *length) : std::nullopt;
  }
};

// V is the largest of: inflow, start, holds, solids and belts as the scene states them, and what the forces can drive,
// a balance with viscosity and, with inertia, not more than the balance with inertia:
//   gravity          rho g L²/mu        sqrt(g L)          not on a bath or a solid, which carry the weight
//   surface tension  2 gamma L/(mu h)   sqrt(2 gamma/(rho h))  [Taylor 1959, Culick 1960]
//   pressure         p L²/(mu h)        sqrt(p L/(rho h))
//   wind             likewise, its pressure; on what floats its friction on one face, over the bath's drag at most
//   its weight       on a solid along which it flows, the speed of the layer (layer_scales.h), not more than sqrt(2 g
//   L)
// Of a liquid that is not Newtonian the rate of each balance, V/L, is that of its stress, rho g L, 2 gamma/h or p L/h
// (material/driven_rate.h): none where it is borne by the yield stress.
[[nodiscard]] Scales scales_of(const Scene& scene, const SheetTable& sheet, const Measured& measured);

// Of each sheet; measured: likewise, or of none.
[[nodiscard]] std::vector<Scales> scales_of_sheets(const Scene& scene, std::span<const Measured> measured);

} // namespace sheet::scene
