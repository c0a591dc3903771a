// SPDX-License-Identifier: GPL-3.0-or-later
// Viscosity by temperature against the laws as they are written, published values, and their slopes against
// differences.
#include "libsheet/material/temperature_law.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sheet {
namespace {

using enum TemperatureLawKind;

constexpr double celsius = 273.15;

// Float glass DGG I of the Deutsche Glastechnische Gesellschaft, log10 of Pa s.
TemperatureLaw float_glass(double reference) {
  return {.kind = vft,
          .reference_temperature = reference,
          .vft_a = -2.601,
          .vft_b = 4330.9,
          .vft_temperature = 246.1 + celsius};
}

TemperatureLaw tabulated_glass() {
  TemperatureLaw law{.kind = table, .reference_temperature = 1000};
  const ViscosityShift glass(float_glass(1000));
  for (double t = 900; t <= 1500; t += 25) {
    law.temperatures.push_back(t);
    law.viscosities.push_back(*reference_viscosity(float_glass(1000)) * glass.factor(t));
  }
  return law;
}

std::vector<TemperatureLaw> temperature_laws() {
  return {{.kind = arrhenius, .reference_temperature = 1400, .activation_energy = 2e5},
          {.kind = exponential, .reference_temperature = 300, .temperature_coefficient = 0.06},
          float_glass(1000),
          {.kind = wlf, .reference_temperature = 373, .wlf_c1 = 17.44, .wlf_c2 = 51.6},
          tabulated_glass()};
}

TEST(TemperatureLaw, HasTheReferenceViscosityAtItsReference) {
  for (const TemperatureLaw& law : temperature_laws())
    EXPECT_NEAR(ViscosityShift(law).factor(law.reference_temperature), 1, 1e-14);
  EXPECT_EQ(ViscosityShift().factor(273), 1);
  EXPECT_EQ(ViscosityShift(TemperatureLaw{}).at(273).log_slope, 0);
}

TEST(TemperatureLaw, OfFloatGlassHasItsFixedPoints) {
  // The law, log10(η/(dPa s)) = -1.601 + 4330.9/(t - 246.1), solved for the fixed points of glass makers.
  const ViscosityShift glass(float_glass(1000));
  const double at_reference = *reference_viscosity(float_glass(1000));
  for (const double digits : {4.0, 7.6, 13.0}) { // working, softening (Littleton), annealing point, in dPa s
    const double t = 246.1 + 4330.9 / (digits + 1.601) + celsius;
    EXPECT_NEAR(at_reference * glass.factor(t), std::pow(10, digits - 1), 1e-11 * std::pow(10, digits - 1));
  }
}

TEST(TemperatureLaw, IsTheLaw) {
  const ViscosityShift arrhenius_shift(temperature_laws()[0]), exponential_shift(temperature_laws()[1]),
      wlf_shift(temperature_laws()[3]);
  EXPECT_NEAR(arrhenius_shift.factor(1300), std::exp(2e5 / 8.31446261815324 * (1 / 1300.0 - 1 / 1400.0)), 1e-13);
  EXPECT_NEAR(exponential_shift.factor(290), std::exp(0.6), 1e-14);
  EXPECT_NEAR(wlf_shift.factor(383), std::pow(10, -17.44 * 10 / 61.6), 1e-16);
  EXPECT_NEAR(wlf_shift.factor(363), std::pow(10, 17.44 * 10 / 41.6), 1e-9);
}

TEST(TemperatureLaw, OfATableIsItsRowsAndSmoothBetween) {
  const TemperatureLaw law = tabulated_glass();
  const ViscosityShift shift(law), glass(float_glass(1000));
  EXPECT_NEAR(*reference_viscosity(law), *reference_viscosity(float_glass(1000)), 1e-9 * *reference_viscosity(law));
  for (std::size_t i = 0; i < law.temperatures.size(); ++i)
    EXPECT_NEAR(shift.factor(law.temperatures[i]), glass.factor(law.temperatures[i]),
                1e-12 * glass.factor(law.temperatures[i]));
  for (double t = 950; t < 1450; t += 7)
    EXPECT_NEAR(std::log(shift.factor(t)), std::log(glass.factor(t)), 2e-3) << t;
}

TEST(TemperatureLaw, SlopesAreThoseOfTheFactor) {
  for (const TemperatureLaw& law : temperature_laws()) {
    const ViscosityShift shift(law);
    for (const double by : {-13.0, 4.0, 29.0}) {
      const double t = law.reference_temperature + by, step = 1e-4;
      const double slope = (std::log(shift.factor(t + step)) - std::log(shift.factor(t - step))) / (2 * step);
      EXPECT_NEAR(shift.at(t).log_slope, slope, 1e-7 * std::abs(slope)) << static_cast<int>(law.kind) << ' ' << t;
    }
  }
}

TEST(TemperatureLaw, EndsWhereItSaysNothing) {
  const TemperatureLaw glass = float_glass(1000), tabulated = tabulated_glass();
  EXPECT_FALSE(range_of(glass).holds(293));
  EXPECT_TRUE(range_of(glass).holds(800));
  EXPECT_FALSE(range_of(temperature_laws()[3]).holds(321));
  EXPECT_TRUE(range_of(temperature_laws()[3]).holds(322));
  EXPECT_FALSE(range_of(tabulated).holds(1501));
  EXPECT_TRUE(range_of(temperature_laws()[0]).holds(1e4));
  for (const double cold : {20.0, 519.25, 530.0}) {
    EXPECT_EQ(ViscosityShift(glass).factor(cold), glass.greatest_factor) << cold;
    EXPECT_EQ(ViscosityShift(temperature_laws()[1]).factor(1e6), 1 / temperature_laws()[1].greatest_factor);
    EXPECT_EQ(ViscosityShift(glass).at(cold).log_slope, 0);
  }
  EXPECT_EQ(ViscosityShift(temperature_laws()[3]).factor(300), temperature_laws()[3].greatest_factor);
  EXPECT_EQ(ViscosityShift(tabulated).factor(600), ViscosityShift(tabulated).factor(900));
  EXPECT_EQ(ViscosityShift(tabulated).at(600).log_slope, 0);
}

TEST(TemperatureLaw, TellsTheTemperatureOfAFactor) {
  for (const TemperatureLaw& law : temperature_laws()) {
    const ViscosityShift shift(law);
    const double t = law.reference_temperature + 11.5;
    EXPECT_NEAR(shift.temperature_of(shift.factor(t), 200, 3000), t, 1e-9 * t);
  }
}

} // namespace
} // namespace sheet
