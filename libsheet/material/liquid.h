// SPDX-License-Identifier: GPL-3.0-or-later
// What a liquid is, told once: what a scene says of it, and what every formula asks of it. SI units.
#pragma once
#include "libsheet/material/strain_rate.h"

namespace sheet {

struct Liquid {
  double viscosity = 0;       // dynamic, at rest [Pa s]; 0: inviscid, needs inertia
  double density = 0;         // [kg/m³]; 0: not given, then neither inertia nor gravity nor an inflow's mass matter
  double surface_tension = 0; // of each of the two surfaces [N/m]; 0: no such term

  [[nodiscard]] bool viscous() const { return viscosity > 0; }
  bool operator==(const Liquid&) const = default;
};

// The viscosity of a liquid that is strained so [Pa s]. It is Newtonian: the same at every rate.
[[nodiscard]] inline double viscosity_of(const Liquid& liquid, StrainRate) { return liquid.viscosity; }

} // namespace sheet
