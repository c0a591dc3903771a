// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous bending by hinges [Grinspun et al. 2003; Batty et al. 2012, section 3.2], as a potential of one stage of
// duration τ:
//   W = (k μ ĥ³/τ) (θ - θ̄)² 3 l̂²/Â,   k = 1/3 as printed (Y h³/(12 (1 - ν²)) with Y = 3μ, ν = 1/2), 1/18 as the default
//   hinge.
// θ: angle between the two normals [rad], θ̄ its reference; μ the mean viscosity, ĥ the mean thickness, Â the sum of the
// areas, l̂ the length of the edge, all three by the metric that raises indices (Stage::raised). No constant is right
// for every mesh (docs/speed-error.md, V11).
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

class Hinge {
public:
  static constexpr Stencil stencil = Stencil::hinge;
  Hinge(bool as_printed, const Connectivity& mesh);
  [[nodiscard]] const char* name() const { return as_printed_ ? "bending (hinge as printed)" : "bending (hinge)"; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return nodes_[i]; }
  void begin(const Stage& stage);
  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const;
  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const;

private:
  bool as_printed_;
  std::vector<std::array<std::uint32_t, 4>> nodes_;
  std::vector<std::uint32_t> edges_;       // of the hinges
  std::vector<double> weight_, reference_; // [J], [rad]
};

} // namespace sheet
