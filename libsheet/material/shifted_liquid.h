// SPDX-License-Identifier: GPL-3.0-or-later
// Liquids at a temperature. All of a flow curve shifts along the rate, τ(γ̇, T) = τ(a_T γ̇, T_r) [time-temperature
// superposition: Ferry 1980, chapter 11]: viscosities grow by a_T, rates shrink by it, and stresses stay, the yield
// stress among them.
#pragma once
#include "libsheet/material/flow_curve.h"
#include "libsheet/material/liquid.h"

namespace sheet {

// A flow curve of which all is shifted by a_T.
struct ShiftedCurve {
  const FlowCurve& curve;
  double shift;
  [[nodiscard]] double viscosity(StrainRate rate) const {
    return shift * curve.viscosity({shift * shift * rate.squared});
  }
  [[nodiscard]] double tangent_viscosity(StrainRate rate) const {
    return shift * curve.tangent_viscosity({shift * shift * rate.squared});
  }
};

// What the liquid is at the temperature [K], as one that does not depend on it.
[[nodiscard]] Liquid at_temperature(const Liquid& liquid, double temperature);

} // namespace sheet
