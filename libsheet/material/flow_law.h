// SPDX-License-Identifier: GPL-3.0-or-later
// How a liquid's viscosity depends on the rate of strain γ̇ = sqrt(2 D:D), as a scene says it. SI units.
#pragma once
#include <optional>
#include <vector>

namespace sheet {

// μ stands for the liquid's `viscosity`, n for flow_index, τ_y for yield_stress; K γ̇_r^(n-1) = μ at the reference
// rate.
enum class FlowLawKind {
  newtonian, // η = μ
  power,     // η = K γ̇^(n-1) [Ostwald 1925]; ice: n = 1/3 [Glen 1955]
  carreau,   // η = η∞ + (μ - η∞) (1 + (λγ̇)^a)^((n-1)/a) [Carreau 1972; Yasuda 1979], a the transition
  cross,     // η = η∞ + (μ - η∞)/(1 + (λγ̇)^(1-n)) [Cross 1965]
  bingham,   // η = τ_y/γ̇ + μ [Bingham 1922]
  herschel_bulkley, // η = τ_y/γ̇ + K γ̇^(n-1) [Herschel and Bulkley 1926]
  casson,           // sqrt(ηγ̇) = sqrt(τ_y) + sqrt(μγ̇) [Casson 1959]
  table             // ln η over ln γ̇, a monotone spline; constant beyond its ends
};

struct FlowLaw {
  FlowLawKind kind = FlowLawKind::newtonian;
  double flow_index = 1;                            // n
  double reference_rate = 1;                        // γ̇_r, at which a power law or a table has its viscosity [1/s]
  double yield_stress = 0;                          // τ_y [Pa]
  double infinite_viscosity = 0;                    // η∞ [Pa s]
  double time_constant = 0;                         // λ [s]
  double transition = 2;                            // a
  std::optional<double> rest_rate = {};             // ε; absent: rest_rate() of flow_curve.h [1/s]
  std::vector<double> rates = {}, viscosities = {}; // of a table, ascending [1/s], [Pa s]

  [[nodiscard]] bool newtonian() const { return kind == FlowLawKind::newtonian; }
  [[nodiscard]] bool yields() const {
    return kind == FlowLawKind::bingham || kind == FlowLawKind::herschel_bulkley || kind == FlowLawKind::casson;
  }
  // Whether the potential of its dissipation is a sum of powers.
  [[nodiscard]] bool elementary() const {
    return kind != FlowLawKind::cross && kind != FlowLawKind::table &&
           (kind != FlowLawKind::carreau || transition == 2);
  }
  bool operator==(const FlowLaw&) const = default;
};

} // namespace sheet
