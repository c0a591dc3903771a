// SPDX-License-Identifier: GPL-3.0-or-later
// A liquid's flow curve τ(γ̇) = η γ̇ as formulas need it: by x = γ̇², which needs no root of 0.
//   φ(x) = ∫ τ dγ̇, the potential of dissipation;  η = 2 dφ/dx;  d = 2 dη/dx = (dη/dγ̇)/γ̇.
// Most laws are sums of powers of s + t x (power_sum.h). Powers of γ̇ itself have s = ε², ε the rest rate: below it the
// liquid is Newtonian, with τ_y = η ε [Bercovier and Engelman 1980]. What has no such form is integrated once, over ln
// γ̇ [Gauss].
#pragma once
#include <memory>

#include "libsheet/material/flow_point.h"
#include "libsheet/material/liquid.h"
#include "libsheet/material/power_sum.h"
#include "libsheet/material/strain_rate.h"

namespace sheet {

class IntegratedCurve;

class FlowCurve {
public:
  FlowCurve() = default; // inviscid
  explicit FlowCurve(const Liquid& liquid);
  // The same with another rest rate.
  FlowCurve(const Liquid& liquid, double rest_rate);

  [[nodiscard]] bool newtonian() const { return powers_.terms == 0 && !integrated_; }
  [[nodiscard]] FlowPoint at(double squared_rate) const;
  [[nodiscard]] double viscosity(StrainRate rate) const {
    return newtonian() ? powers_.infinite : at(rate.squared).viscosity;
  }
  // η + η' γ̇, by which the stress grows with the rate: what small disturbances of a flow feel [Pa s].
  [[nodiscard]] double tangent_viscosity(StrainRate rate) const;
  // η γ̇ [Pa].
  [[nodiscard]] double stress(double rate) const { return at(rate * rate).viscosity * rate; }

private:
  friend void flow_points(const FlowCurve& curve, int count, const double* squared_rates, double* potentials,
                          double* viscosities, double* slopes);

  PowerSum powers_; // also of what is Newtonian
  std::shared_ptr<const IntegratedCurve> integrated_;
};

// ε: the law's, or a hundred thousandth of its own rate, that of its yield stress, (τ_y/K)^(1/n) or τ_y/μ, or the
// reference rate [1/s]. 0 where nothing depends on it.
[[nodiscard]] double rest_rate(const Liquid& liquid);

// Of what yields, a curve so soft that its viscosity at rest is a few times that above yield: for what knows viscosity
// only as it was a moment ago, and must not be locked by it.
[[nodiscard]] FlowCurve soft_curve(const Liquid& liquid);
// Its rest rate, over that at which the liquid yields.
inline constexpr double softest = 0.3;

// The rate at which the yield stress is as large as what is above it: (τ_y/K)^(1/n), or τ_y/μ [1/s]; 0 where none is.
[[nodiscard]] double yield_rate(const Liquid& liquid);

// The same as the curve's, for one rate.
[[nodiscard]] double viscosity_of(const Liquid& liquid, StrainRate rate);

// Of `count` squared rates at once.
void flow_points(const FlowCurve& curve, int count, const double* squared_rates, double* potentials,
                 double* viscosities, double* slopes);

} // namespace sheet
