// SPDX-License-Identifier: GPL-3.0-or-later
// Liquids at a temperature: their flow curves are the shifted ones.
#include "libsheet/material/shifted_liquid.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sheet {
namespace {

std::vector<FlowLaw> shifted_laws() {
  using enum FlowLawKind;
  return {{},
          {.kind = power, .flow_index = 0.4, .reference_rate = 3, .rest_rate = 1e-4},
          {.kind = carreau, .flow_index = 0.3, .infinite_viscosity = 0.2, .time_constant = 1.5},
          {.kind = carreau, .flow_index = 0.3, .infinite_viscosity = 0.2, .time_constant = 1.5, .transition = 0.8},
          {.kind = cross, .flow_index = 0.4, .infinite_viscosity = 0.2, .time_constant = 1.5},
          {.kind = bingham, .yield_stress = 12},
          {.kind = herschel_bulkley, .flow_index = 0.5, .reference_rate = 4, .yield_stress = 12},
          {.kind = casson, .yield_stress = 12},
          {.kind = table, .rates = {0.1, 1, 10, 100, 1000}, .viscosities = {9, 5, 2, 1, 0.8}}};
}

Liquid warm(FlowLaw law) {
  Liquid liquid{.viscosity = 5, .density = 1000, .surface_tension = 0.04, .law = std::move(law)};
  liquid.temperature_law = {
      .kind = TemperatureLawKind::arrhenius, .reference_temperature = 320, .activation_energy = 5e4};
  liquid.surface_tension_slope = -1e-4;
  return liquid;
}

TEST(ShiftedLiquid, HasTheShiftedCurve) {
  for (const FlowLaw& law : shifted_laws())
    for (const double temperature : {290.0, 320.0, 380.0}) {
      const Liquid liquid = warm(law), there = at_temperature(liquid, temperature);
      const FlowCurve curve(liquid), own(there);
      const ShiftedCurve shifted{curve, ViscosityShift(liquid.temperature_law).factor(temperature)};
      EXPECT_FALSE(there.thermal());
      for (double rate = 1e-3; rate < 1e4; rate *= 7) {
        const double wanted = shifted.viscosity({rate * rate});
        EXPECT_NEAR(own.viscosity({rate * rate}), wanted, 1e-7 * wanted) << static_cast<int>(law.kind) << ' ' << rate;
        const double tangent = shifted.tangent_viscosity({rate * rate});
        EXPECT_NEAR(own.tangent_viscosity({rate * rate}), tangent, 1e-5 * wanted) << static_cast<int>(law.kind);
      }
    }
}

TEST(ShiftedLiquid, YieldsAtTheSameStress) {
  for (const double temperature : {290.0, 380.0})
    EXPECT_EQ(at_temperature(warm({.kind = FlowLawKind::bingham, .yield_stress = 12}), temperature).law.yield_stress,
              12);
}

TEST(ShiftedLiquid, TensionIsLinearAndNeverNegative) {
  const Liquid liquid = warm({});
  EXPECT_DOUBLE_EQ(at_temperature(liquid, 320).surface_tension, 0.04);
  EXPECT_DOUBLE_EQ(at_temperature(liquid, 420).surface_tension, 0.03);
  EXPECT_EQ(at_temperature(liquid, 1000).surface_tension, 0);
}

} // namespace
} // namespace sheet
