// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous bending by mid-edge directors [Grinspun et al. 2006], as a potential of one stage of duration τ:
//   W = (V μ ĥ²/(12 τ)) (tr(S²) + tr(S)²),   S = â⁻¹ (b - b̄),   ĥ = V/Â.
// b: second fundamental form from the directors (geometry/director.h), b̄ its reference; the metric â that raises
// indices and its area Â as in membrane.h. On edges: β_k = b(e_k, e_k) = -2 (g_i + g_j). With arcs, also the membrane,
// edges taken for circular arcs: squared lengths |e_k|² + β_k²/12 in the first fundamental form, which takes away the
// leading part of the locking of flat triangles (docs/speed-error.md). The membrane term is then absent, and what works
// on area (area_loads.h) does so on √det Q/2, Q those squared lengths.
//
// Flat caps, triangles with an angle α above 157 degrees, also have
//   k (g - ḡ)²/2,   k = (-cos α - c)/(1 - c) (V μ ĥ²/(6 τ)) 4/H⁴,   c = -cos 157°,
// g the height of the longest edge's director, H the triangle's height over that edge. Without it the vertex at α can
// pop out by δ, which turns the triangle by δ/H while its three directors stay as they are: b sees a bump as long as
// the edge only, so compressed caps fold over. The term is half a hinge at the longest edge, which holds face and
// director together (docs/hard-cases.md).
//
// Where a director leans by α > 45 degrees from a triangle's normal at the start of the step, as it must at folds above
// 90 degrees, its height g = H sin α, H the triangle's over the edge, counts the less: p g takes its place, and the
// triangle also has
//   k (α - ᾱ)²/2,   k = (1 - p²) (V μ ĥ²/(6 τ)) 4/H²,   p = (cos α₀ - cos 75°)/(cos 45° - cos 75°), from 1 to 0.
// At 90 degrees nothing else would hold it, as g hardly changes any more when it turns; and arcs are longest there, so
// that tension would be at the top of a hill, where Newton's iterations go round with the director. One that is held
// has p = 1, and 1 - √2 cos α₀ in place of 1 - p².
//
// A liquid that is not Newtonian has, with the potential φ of its flow curve and arcs,
//   W = V τ Σ w φ(γ̇²(z)),   γ̇²(z) = 2 rᵀ𝔇r,   r(z) = (Q - Q̄)/(2τ) - z (β - β̄)/τ,
// summed over two points of Gauss in each half of the thickness, and 𝔇 m·m = tr(m²) + tr(m)² of a form m on edges. Its
// forces and Hessians follow from a = 𝔇 r(0), b = 𝔇 (β - β̄)/τ and moments over z of η and d (flow_curve.h). Caps,
// leaning directors, and bending without arcs have the viscosity that the stage predicts.
//
// Where rates change by orders of magnitude plain Newton is slow, and fails as the rest rate of what yields goes to 0.
// So where it thins, d < 0, the stress is an unknown of Newton's, eliminated at each point [Chan, Golub and Mulet 1999;
// Rudi, Shih and Stadler 2020]: in the Hessian d c cᵀ, c = 𝔇 r, becomes
//   (d/η) (c (𝔇p)ᵀ + (𝔇p) cᵀ)/2,   (2 pᵀ𝔇p)^½ <= η²/|dη/dγ̇|,
// and a direction δ takes p to η (r + δr) + (d/η) (2 rᵀ𝔇δr) p. At the solution p = η r, where this is the Hessian.
#pragma once
#include <array>

#include "libsheet/energy/area_loads.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/energy_sum.h"
#include "libsheet/energy/liquid_flows.h"
#include "libsheet/energy/mid_edge_kernels.h"

namespace sheet {

class MidEdgeShell {
public:
  static constexpr Stencil stencil = Stencil::triangle_edges;
  explicit MidEdgeShell(bool arcs) : arcs_(arcs) {}
  // With arcs, on whose area `loads` work.
  explicit MidEdgeShell(AreaLoads loads) : arcs_(true), area_loads_(std::move(loads)) {}
  [[nodiscard]] const char* name() const {
    return !arcs_              ? "bending (mid-edge)"
           : area_loads_.any() ? "membrane, bending and area (mid-edge, arcs)"
                               : "membrane and bending (mid-edge, arcs)";
  }
  [[nodiscard]] std::size_t size() const { return triangles_; }
  [[nodiscard]] bool has(Kind kind) const {
    return kind == Kind::dissipative || (kind == Kind::elastic && area_loads_.any());
  }
  void begin(const Stage& stage);
  // The cosines and sines of the angles of u.
  void prepare(const Unknowns& u);
  // See term.h.
  void follow(const Unknowns& u, const Unknowns& step);
  void add_dissipated(const Unknowns& u, std::span<double> energy) const;
  void rest_at(std::span<const double> rates) { flows_.rest_at(rates); }

  // Elements first to last-1, their unknowns `stride` apart; see term.h. Gradients, unless null, are set or added to,
  // of Hessians (none: null) the lower triangles.
  EnergySum evaluate(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                     double* hessians, bool definite, bool overwrite) const;
  // The part of the exact Hessians that is of one kind, set; see term.h.
  void hessians_of(Kind kind, std::size_t first, std::size_t last, const double* u, int stride, double* hessians) const;
  // Of one element, for tests. In evaluate and hessians_of, `first` is a multiple of lane_count.
  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const;
  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const;

private:
  void refer(const Stage& stage, std::size_t batch);
  void load(const Stage& stage, std::size_t batch);
  void gather(const Unknowns& u, std::size_t first, LaneNumbers (&to)[12]) const;
  [[nodiscard]] MidEdgeState global_state(const Unknowns& u, std::size_t first) const;
  [[nodiscard]] const MidEdgeLoads* loads_of(std::size_t i) const {
    return loads_.empty() ? nullptr : &loads_[i / lane_count];
  }
  [[nodiscard]] MidEdgeState state_of(std::size_t first, int used, const double* u, int stride) const;
  [[nodiscard]] static MidEdgeState state_of(const VectorN<12>& u);

  using LaneCurves = std::array<const FlowCurve*, lane_count>;
  void find_lanes();
  [[nodiscard]] MidEdgeFlow flow_of(std::size_t i) const;

  bool arcs_;
  bool curved_ = false; // a liquid is not Newtonian
  LiquidFlows flows_;
  std::vector<LaneCurves> lanes_; // of lane_count triangles each; empty where the liquid is the same everywhere
  AreaLoads area_loads_;
  std::shared_ptr<const Connectivity> mesh_;
  std::size_t triangles_ = 0;
  std::vector<MidEdgeReference> references_; // of lane_count triangles each
  std::vector<MidEdgeLoads> loads_;          // likewise; empty: none
  std::vector<MidEdgeStress> stresses_;      // likewise, where the liquid is not Newtonian, once Newton has gone a step
  std::vector<double> cosine_, sine_;        // of the edges' angles
};

} // namespace sheet
