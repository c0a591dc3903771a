// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of walls against the closed forms of Newtonian liquids, power laws and Herschel-Bulkley liquids, over twelve
// decades of the velocity.
#include "libsheet/material/wall_flow.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheet {
namespace {

// Of τ = τ_y + K γ̇^n, with s = τ_w - τ_y: u = h K^-m s^(m+1)/τ_w² (s/(m+2) + τ_y/(m+1)) + b (s/K)^m, m = 1/n.
double herschel_bulkley(double above, double yield, double consistency, double n, double h, double b) {
  const double m = 1 / n, stress = yield + above;
  return h * std::pow(consistency, -m) * std::pow(above, m + 1) / (stress * stress) *
             (above / (m + 2) + yield / (m + 1)) +
         b * std::pow(above / consistency, m);
}

TEST(WallFlow, OfPowerLaws) {
  for (const double n : {0.2, 1.0 / 3, 0.5, 1.0, 1.5})
    for (const double b : {0.0, 0.03}) {
      const WallFlow flow({.viscosity = 3, .law = {.kind = FlowLawKind::power, .flow_index = n, .rest_rate = 1e-15}});
      for (double g = 1e-5; g < 1e7; g *= 10) {
        const double h = 0.2, u = h * n / (2 * n + 1) * g + b * g, stress = 3 * std::pow(g, n);
        const WallFlow::Drag drag = flow.drag(u, h, b);
        EXPECT_NEAR(drag.stress, stress, 1e-8 * stress) << n << " " << g;
        // Ψ is homogeneous of the degree 1 + n where b = 0.
        if (b == 0) {
          EXPECT_NEAR(drag.potential, stress * u / (1 + n), 1e-8 * stress * u) << n << " " << g;
        }
        EXPECT_NEAR(drag.slope, n * stress / u, 1e-7 * stress / u) << n << " " << g;
        EXPECT_NEAR(flow.velocity(stress, h, b), u, 1e-8 * u);
      }
    }
}

TEST(WallFlow, OfHerschelBulkleyLiquids) {
  for (const double n : {0.3, 0.5, 1.0})
    for (const double b : {0.0, 0.03}) {
      const WallFlow flow(
          {.viscosity = 3,
           .law = {.kind = FlowLawKind::herschel_bulkley, .flow_index = n, .yield_stress = 20, .rest_rate = 1e-12}});
      for (double above = 1e-1; above < 1e4; above *= 10) {
        const double u = herschel_bulkley(above, 20, 3, n, 0.2, b);
        EXPECT_NEAR(flow.drag(u, 0.2, b).stress, 20 + above, 1e-6 * (20 + above)) << n << " " << above;
      }
    }
}

// At any velocity the potential lies between those of the yield stress alone and of twice the stress.
TEST(WallFlow, IsFoundAtAnyVelocity) {
  for (const FlowLawKind kind : {FlowLawKind::bingham, FlowLawKind::casson}) {
    const WallFlow flow({.viscosity = 2, .law = {.kind = kind, .yield_stress = 30}});
    for (int i = 0; i < 20000; ++i) {
      const double u = std::pow(10, -9 + 9 * i / 20000.0);
      const WallFlow::Drag drag = flow.drag(u, 0.015, 0);
      EXPECT_TRUE(drag.potential > 0 && drag.potential <= drag.stress * u && drag.potential >= drag.stress * u / 2)
          << u;
      EXPECT_TRUE(drag.slope > 0 && drag.slope < 1.0001 * drag.stress / u) << u;
    }
  }
}

TEST(WallFlow, DerivesFromItsPotential) {
  for (const FlowLaw& law :
       {FlowLaw{.kind = FlowLawKind::carreau, .flow_index = 0.3, .infinite_viscosity = 0.1, .time_constant = 2},
        FlowLaw{.kind = FlowLawKind::casson, .yield_stress = 20, .rest_rate = 1e-3},
        FlowLaw{.kind = FlowLawKind::cross, .flow_index = 0.3, .time_constant = 2}}) {
    const WallFlow flow({.viscosity = 3, .law = law});
    for (double u = 1e-7; u < 1e4; u *= 13) {
      const double by = 1e-3 * u;
      for (const double b : {0.0, 0.01}) {
        const WallFlow::Drag here = flow.drag(u, 0.2, b), less = flow.drag(u - by, 0.2, b),
                             more = flow.drag(u + by, 0.2, b);
        EXPECT_NEAR((more.potential - less.potential) / (2 * by), here.stress, 1e-6 * here.stress) << u;
        EXPECT_NEAR((more.stress - less.stress) / (2 * by), here.slope, 1e-6 * here.stress / u) << u;
      }
      // Hardly any slip is as good as none, which takes the shorter way.
      const WallFlow::Drag none = flow.drag(u, 0.2, 0), hardly = flow.drag(u, 0.2, 1e-14);
      EXPECT_NEAR(none.potential, hardly.potential, 1e-8 * hardly.potential) << u;
      EXPECT_NEAR(none.stress, hardly.stress, 1e-8 * hardly.stress) << u;
      EXPECT_NEAR(none.slope, hardly.slope, 1e-5 * hardly.slope) << u;
    }
  }
}

} // namespace
} // namespace sheet
