// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous stretching of flat triangles [Batty et al. 2012, eq. (3), as a potential of one step of duration τ]:
//   W = (V μ/τ) (tr(E²) + tr(E)²),   E = â⁻¹ (a - ā)/2.
// a: first fundamental form, ā: its reference, â: the metric that raises indices (Stage::raised), V: the triangle's
// volume [m³], μ: viscosity [Pa s]. A liquid that is not Newtonian has, with the potential φ of its flow curve,
//   W = V τ φ(γ̇²),   γ̇² = 2 (tr(E²) + tr(E)²)/τ²,
// and Newton's Hessian has a stress of its own as mid_edge_shell.h says. With â the metric at the stage's
// end the weight μ V = μ h A couples thickness and area exactly; with â the metric at the start it is the paper's
// explicit thickness.
#pragma once
#include "libsheet/energy/element.h"
#include "libsheet/energy/liquid_flows.h"

namespace sheet {

class Membrane {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  [[nodiscard]] const char* name() const { return "membrane"; }
  [[nodiscard]] std::size_t size() const { return reference_.size(); }
  void begin(const Stage& stage);
  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const;
  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const;
  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const;

  // See term.h.
  void follow(const Unknowns& u, const Unknowns& step);
  void add_dissipated(const Unknowns& u, std::span<double> energy) const;
  void rest_at(std::span<const double> rates) { flows_.rest_at(rates); }

private:
  [[nodiscard]] double curved_derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>* hessian,
                                          bool definite) const;

  std::vector<RaisedMetric> raised_; // â
  std::vector<Vector3> reference_;   // squared edge lengths ā [m²]
  std::vector<double> weight_;       // V μ/(2τ) [J]; of a liquid that is not Newtonian V/(2τ)
  LiquidFlows flows_;
  std::vector<double> duration_; // τ, reduced by temperature (stage.h) [s]
  std::vector<Vector3> stress_;  // of a liquid that is not Newtonian, once Newton has gone a step [Pa m²]
  std::shared_ptr<const Connectivity> mesh_;
};

} // namespace sheet
