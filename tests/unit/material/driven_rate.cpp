// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/material/driven_rate.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sheet {
namespace {

TEST(DrivenRate, IsTheFlowCurveReadTheOtherWayRound) {
  const Liquid newtonian{.viscosity = 4};
  EXPECT_EQ(driven_rate(newtonian, 12), 3);
  EXPECT_EQ(driven_rate(Liquid{}, 12), std::numeric_limits<double>::infinity());
  const Liquid power{.viscosity = 8, .law = {.kind = FlowLawKind::power, .flow_index = 0.5, .reference_rate = 4}};
  EXPECT_NEAR(driven_rate(power, 16 * 3), 9, 1e-8); // K = 16 Pa s^(1/2)
  const Liquid carreau{.viscosity = 2,
                       .law = {.kind = FlowLawKind::carreau, .flow_index = 0.5, .time_constant = 1, .transition = 1}};
  EXPECT_NEAR(driven_rate(carreau, 2 * 3 / std::sqrt(1 + 3.0)), 3, 1e-6);
}

TEST(DrivenRate, IsNoneBelowTheYieldStress) {
  Liquid liquid{.viscosity = 3, .law = {.kind = FlowLawKind::bingham, .yield_stress = 20}};
  EXPECT_EQ(driven_rate(liquid, 20), 0);
  EXPECT_NEAR(driven_rate(liquid, 26), 2, 1e-6);
  liquid.law.kind = FlowLawKind::casson;
  EXPECT_NEAR(driven_rate(liquid, std::pow(std::sqrt(20.0) + std::sqrt(12.0), 2)), 4, 1e-6);
}

} // namespace
} // namespace sheet
