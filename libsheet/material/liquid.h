// SPDX-License-Identifier: GPL-3.0-or-later
// What a liquid is, told once: what a scene says of it. What formulas ask of it, flow_curve.h answers. SI units.
#pragma once
#include <algorithm>

#include "libsheet/material/flow_law.h"
#include "libsheet/material/temperature_law.h"

namespace sheet {

struct Liquid {
  double viscosity = 0;       // dynamic [Pa s], as its law has it; 0: inviscid, needs inertia
  double density = 0;         // [kg/m³]; 0: not given, then neither inertia nor gravity nor an inflow's mass matter
  double surface_tension = 0; // of each of the two surfaces [N/m]; 0: no such term
  FlowLaw law = {};           // how viscosity depends on the rate of strain
  TemperatureLaw temperature_law = {}; // and on temperature; viscosity and tension are those at its reference
  double surface_tension_slope = 0;    // dγ/dT [N/(m K)]

  [[nodiscard]] bool viscous() const { return viscosity > 0; }
  // Whether anything of it depends on temperature.
  [[nodiscard]] bool thermal() const { return !temperature_law.constant() || surface_tension_slope != 0; }
  // γ(T), not below 0 [N/m].
  [[nodiscard]] double surface_tension_at(double temperature) const {
    return std::max(0.0,
                    surface_tension + surface_tension_slope * (temperature - temperature_law.reference_temperature));
  }
  bool operator==(const Liquid&) const = default;
};

} // namespace sheet
