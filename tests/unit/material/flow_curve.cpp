// SPDX-License-Identifier: GPL-3.0-or-later
// Flow curves against the laws as they are written, and their derivatives against differences.
#include "libsheet/material/flow_curve.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace sheet {
namespace {

struct Law {
  const char* name;
  Liquid liquid;
  std::function<double(double)> stress; // by the rate
};

Liquid liquid_of(FlowLaw law, double viscosity) { return {.viscosity = viscosity, .law = std::move(law)}; }

std::vector<Law> laws() {
  using enum FlowLawKind;
  std::vector<double> rates, viscosities;
  for (double rate = 0.01; rate < 200; rate *= 1.3) {
    rates.push_back(rate);
    viscosities.push_back(5 * std::pow(rate, -0.4));
  }
  return {
      {"newtonian", liquid_of({}, 3), [](double g) { return 3 * g; }},
      {"thinning", liquid_of({.kind = power, .flow_index = 1.0 / 3, .reference_rate = 8}, 3),
       [](double g) { return 3 * std::pow(g / 8, -2.0 / 3) * g; }},
      {"thickening", liquid_of({.kind = power, .flow_index = 1.5}, 3), [](double g) { return 3 * std::pow(g, 1.5); }},
      {"carreau", liquid_of({.kind = carreau, .flow_index = 0.3, .infinite_viscosity = 0.2, .time_constant = 1.5}, 7),
       [](double g) { return (0.2 + 6.8 * std::pow(1 + 2.25 * g * g, -0.35)) * g; }},
      {"carreau-yasuda",
       liquid_of(
           {.kind = carreau, .flow_index = 0.3, .infinite_viscosity = 0.2, .time_constant = 1.5, .transition = 0.8}, 7),
       [](double g) { return (0.2 + 6.8 * std::pow(1 + std::pow(1.5 * g, 0.8), -0.7 / 0.8)) * g; }},
      {"cross", liquid_of({.kind = cross, .flow_index = 0.4, .infinite_viscosity = 0.2, .time_constant = 1.5}, 7),
       [](double g) { return (0.2 + 6.8 / (1 + std::pow(1.5 * g, 0.6))) * g; }},
      {"bingham", liquid_of({.kind = bingham, .yield_stress = 12}, 3), [](double g) { return 12 + 3 * g; }},
      {"herschel-bulkley",
       liquid_of({.kind = herschel_bulkley, .flow_index = 0.5, .reference_rate = 4, .yield_stress = 12}, 3),
       [](double g) { return 12 + 6 * std::sqrt(g); }},
      {"casson", liquid_of({.kind = casson, .yield_stress = 12}, 3),
       [](double g) { return std::pow(std::sqrt(12) + std::sqrt(3 * g), 2); }},
      {"table", liquid_of({.kind = table, .rates = rates, .viscosities = viscosities}, 5),
       [](double g) { return 5 * std::pow(g, 0.6); }},
  };
}

TEST(FlowCurve, IsTheLaw) {
  for (const Law& law : laws())
    for (const double rate : {0.05, 0.3, 1.0, 7.0, 90.0})
      EXPECT_NEAR(FlowCurve(law.liquid).stress(rate), law.stress(rate), 1e-6 * law.stress(rate)) << law.name << rate;
}

TEST(FlowCurve, DerivesFromItsPotential) {
  for (const Law& law : laws()) {
    const FlowCurve curve(law.liquid);
    for (const double x : {1e-3, 0.02, 1.0, 30.0, 7e3}) {
      const double by = 1e-5 * x;
      const FlowPoint here = curve.at(x), less = curve.at(x - by), more = curve.at(x + by);
      EXPECT_NEAR((more.potential - less.potential) / by, here.viscosity, 1e-7 * here.viscosity) << law.name << x;
      EXPECT_NEAR((more.viscosity - less.viscosity) / by, here.slope, 1e-6 * here.viscosity / x) << law.name << x;
    }
  }
}

TEST(FlowCurve, HasNoPotentialAndAFiniteViscosityAtRest) {
  for (const Law& law : laws()) {
    const FlowPoint rest = FlowCurve(law.liquid).at(0);
    EXPECT_EQ(rest.potential, 0) << law.name;
    EXPECT_TRUE(std::isfinite(rest.viscosity) && rest.viscosity > 0) << law.name;
    EXPECT_TRUE(std::isfinite(rest.slope)) << law.name;
  }
}

// A table is constant beyond its ends, and its potential goes on without a jump.
TEST(FlowCurve, GoesOnBeyondATable) {
  const Liquid liquid = laws().back().liquid;
  const FlowCurve curve(liquid);
  const std::vector<double>&rates = liquid.law.rates, &viscosities = liquid.law.viscosities;
  EXPECT_NEAR(curve.stress(1e-5), 1e-5 * viscosities.front(), 1e-15);
  EXPECT_NEAR(curve.stress(1e5), 1e5 * viscosities.back(), 1e-5);
  for (const double end : {rates.front(), rates.back()}) {
    const double below = end * (1 - 1e-9), above = end * (1 + 1e-9), stress = curve.stress(end);
    EXPECT_NEAR(curve.at(above * above).potential - curve.at(below * below).potential, stress * (above - below),
                1e-3 * stress * (above - below) + 1e-12 * curve.at(end * end).potential);
  }
}

TEST(FlowCurve, RestsBelowItsOwnRate) {
  const Liquid bingham = liquid_of({.kind = FlowLawKind::bingham, .yield_stress = 12}, 3);
  EXPECT_DOUBLE_EQ(yield_rate(bingham), 4);
  EXPECT_DOUBLE_EQ(rest_rate(bingham), 4e-5);
  EXPECT_NEAR(FlowCurve(bingham).at(0).viscosity, 12 / 4e-5, 10);
  Liquid told = bingham;
  told.law.rest_rate = 0.1;
  EXPECT_DOUBLE_EQ(rest_rate(told), 0.1);
  EXPECT_EQ(rest_rate(liquid_of({}, 3)), 0);
}

// Plateaus that lie farther apart than numbers reach: nearly Newtonian, a transition that hardly begins.
TEST(FlowCurve, BendsHoweverSlowly) {
  using enum FlowLawKind;
  for (const double index : {0.9, 0.98, 0.999}) {
    const FlowCurve curve(liquid_of({.kind = cross, .flow_index = index, .time_constant = 2}, 7));
    for (const double rate : {1e-9, 0.5, 1e9})
      EXPECT_NEAR(curve.viscosity({rate * rate}), 7 / (1 + std::pow(2 * rate, 1 - index)), 1e-9) << index << rate;
  }
  for (const double a : {0.01, 20.0}) {
    const FlowCurve curve(liquid_of({.kind = carreau, .flow_index = 0.4, .time_constant = 2, .transition = a}, 7));
    for (const double rate : {1e-9, 0.5, 1e9})
      EXPECT_NEAR(curve.viscosity({rate * rate}) / 7, std::pow(1 + std::pow(2 * rate, a), -0.6 / a), 1e-9) << a << rate;
  }
}

// The tangent: what a small rate across another one feels is η, along it η + η'γ̇.
TEST(FlowCurve, HasATangent) {
  const FlowCurve curve(liquid_of({.kind = FlowLawKind::power, .flow_index = 1.0 / 3}, 3));
  EXPECT_NEAR(curve.tangent_viscosity({4}), curve.viscosity({4}) / 3, 1e-9);
}

} // namespace
} // namespace sheet
