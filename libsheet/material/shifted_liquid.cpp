// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/shifted_liquid.h"

#include <cmath>

namespace sheet {

Liquid at_temperature(const Liquid& liquid, double temperature) {
  Liquid result = liquid;
  result.temperature_law = {};
  result.surface_tension_slope = 0;
  result.surface_tension = liquid.surface_tension_at(temperature);
  if (liquid.temperature_law.constant())
    return result;
  const double shift = ViscosityShift(liquid.temperature_law).factor(temperature);
  FlowLaw& law = result.law;
  const bool power = law.kind == FlowLawKind::power || law.kind == FlowLawKind::herschel_bulkley;
  result.viscosity *= power ? std::pow(shift, law.flow_index) : shift; // at the same reference rate
  law.infinite_viscosity *= shift;
  law.time_constant *= shift;
  if (law.rest_rate)
    *law.rest_rate /= shift;
  for (double& rate : law.rates)
    rate /= shift;
  for (double& viscosity : law.viscosities)
    viscosity *= shift;
  if (law.kind == FlowLawKind::table)
    result.viscosity = viscosity_of(result, {law.reference_rate * law.reference_rate});
  return result;
}

} // namespace sheet
