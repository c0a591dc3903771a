// SPDX-License-Identifier: GPL-3.0-or-later
// What a liquid is, told once: what a scene says of it. What formulas ask of it, flow_curve.h answers. SI units.
#pragma once
#include "libsheet/material/flow_law.h"

namespace sheet {

struct Liquid {
  double viscosity = 0;       // dynamic [Pa s], as its law has it; 0: inviscid, needs inertia
  double density = 0;         // [kg/m³]; 0: not given, then neither inertia nor gravity nor an inflow's mass matter
  double surface_tension = 0; // of each of the two surfaces [N/m]; 0: no such term
  FlowLaw law = {};           // how viscosity depends on the rate of strain

  [[nodiscard]] bool viscous() const { return viscosity > 0; }
  bool operator==(const Liquid&) const = default;
};

} // namespace sheet
