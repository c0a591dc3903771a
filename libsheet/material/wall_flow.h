// SPDX-License-Identifier: GPL-3.0-or-later
// What a wall does to a layer of a liquid of any flow curve τ(γ̇) that flows along it. In a layer of thickness h with a
// free face the stress falls from τ_w at the wall to 0, so with the wall's rate G = γ̇(τ_w), the slip length b and
//   f(G) = (1/τ²) ∫ τ γ̇ dτ,   the mean velocity is  u = b G + h f(G)
// [as Rabinowitsch 1929 for tubes]; of a Newtonian liquid f = G/3, of a power law n G/(2n + 1). Its potential is
//   Ψ(u) = τ u - Ψ*,   Ψ* = b ∫ G dτ + h ∫ f dτ,   Ψ' = τ,   Ψ'' = τ'/u'(G).
// f and ∫ f dτ depend on the liquid alone and are summed up once, over ln G, to 1e-9; without slip Ψ/h depends on u/h
// alone, and is a spline made from these (log_spline.h).
#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "libsheet/material/flow_curve.h"
#include "libsheet/material/log_spline.h"

namespace sheet {

class WallFlow {
public:
  WallFlow() = default; // of none
  explicit WallFlow(const Liquid& liquid);

  struct Drag {
    double potential = 0; // Ψ [W/m²]
    double stress = 0;    // Ψ' [Pa]
    double slope = 0;     // Ψ'' [Pa s/m]
  };
  // At the mean velocity u > 0 [m/s] of a layer of thickness h, slip length b [m].
  [[nodiscard]] Drag drag(double u, double h, double b) const;
  // Below this rate at the wall it is Newtonian [1/s].
  [[nodiscard]] double newtonian_below() const { return std::exp(first_); }
  // The mean velocity under a stress at the wall [m/s], [Pa].
  [[nodiscard]] double velocity(double stress, double h, double b) const;

private:
  struct Point {
    double f, conjugate; // f [1/s], ∫ f dτ [Pa/s]
  };
  [[nodiscard]] Point at(double log_rate) const;
  [[nodiscard]] double log_rate(double u, double h, double b) const;
  [[nodiscard]] Drag summed_up(double u, double h, double b) const;

  struct Place {
    double rate, stress, rise, f; // G, τ, dτ/d ln G, f
  };
  [[nodiscard]] Place place(double log_rate) const;
  [[nodiscard]] double moment_of_half(double from, double width) const;

  FlowCurve curve_;
  double first_ = 0;                                 // ln G of the first row
  std::vector<double> rates_, stresses_, values_;    // G, τ, f of the rows
  std::vector<double> f_, slope_, conjugate_, rise_; // ln f, d ln f/d ln G, and of ∫ f dτ likewise
  LogSpline without_slip_;                           // Ψ/h over u/h
};

// The same, kept for as long as one liquid is asked for: to sum it up takes as long as a small step. Thread-safe.
[[nodiscard]] std::shared_ptr<const WallFlow> wall_flow_of(const Liquid& liquid);

} // namespace sheet
