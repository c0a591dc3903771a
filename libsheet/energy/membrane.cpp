// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous stretching, written in squared edge lengths: with m = q(x) - q̄, W = V μ/(4τ) mᵀ C m.
#include "libsheet/energy/membrane.h"

#include "libsheet/base/each.h"
#include "libsheet/energy/edge_springs.h"

namespace sheet {

namespace {

// 𝔇 p/η, of a p that is no longer than η²/|dη/dγ̇|: then the Hessian is positive semidefinite.
Vector3 dual_factor(const RaisedMetric& a, const FlowPoint& flow, StrainRate rate, const Vector3& p) {
  const Vector3 raised = a.dissipated(p);
  const double square = flow.viscosity * flow.viscosity;
  const double over = std::sqrt(std::max(0.0, 2 * p.dot(raised)) * rate.squared) * std::max(0.0, -flow.slope);
  return raised * ((over > square ? square / over : 1) / flow.viscosity);
}

} // namespace

void Membrane::begin(const Stage& stage) {
  raised_ = stage.raised;
  flows_.begin(stage);
  stress_.clear();
  mesh_ = stage.start->mesh;
  const auto& triangles = stage.start->mesh->triangles;
  reference_.resize(triangles.size());
  duration_.resize(triangles.size());
  weight_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& v = triangles[t];
    const auto lengths = [&](const Unknowns& u) {
      return squared_lengths(stage.position(u, v[0]), stage.position(u, v[1]), stage.position(u, v[2]));
    };
    const Vector3 start = lengths(stage.begin);
    duration_[t] = stage.reduced_time(t);
    const double rate = flows_.newtonian() ? stage.viscosity[t] / (4 * stage.duration) : 1 / (4 * duration_[t]);
    weight_[t] = 2 * rate * stage.start->volumes[t] * stage.stiffening(t);
    reference_[t] = stage.previous ? Vector3(start + stage.ratio * (lengths(*stage.previous) - start)) : start;
  }
}

double Membrane::value(std::size_t i, const VectorN<9>& u) const {
  const Vector3 m = squared_lengths(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)) - reference_[i];
  const RaisedMetric& a = raised_[i];
  if (!flows_.newtonian())
    return 2 * duration_[i] * duration_[i] * weight_[i] *
           flows_.of(i).at(strain_rate(a, m, duration_[i]).squared).potential;
  const double trace = a.trace.dot(m);
  return weight_[i] * (trace * trace - form_determinant(m) / a.determinant);
}

// With r = m/(2τ), c = 𝔇 r:  ∂W/∂q = V η c,  ∂²W/∂q∂q = V η 𝔇/(2τ) + V d c cᵀ/τ; see mid_edge_shell.h.
double Membrane::curved_derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>* hessian,
                                    bool definite) const {
  const EdgeSprings springs(u);
  const Vector3 m = springs.squared_lengths() - reference_[i];
  const RaisedMetric& a = raised_[i];
  const double duration = duration_[i];
  const FlowPoint flow = flows_.of(i).at(strain_rate(a, m, duration).squared);
  const double volume = 2 * duration * weight_[i];
  const Vector3 c = a.dissipated(m) / (2 * duration), s = volume * flow.viscosity * c;
  springs.gradient(s, gradient);
  if (hessian != nullptr) {
    const Vector3 other =
        stress_.empty() || flow.slope >= 0 ? c : dual_factor(a, flow, strain_rate(a, m, duration), stress_[i]);
    const Matrix3 product = 0.5 * (c * other.transpose() + other * c.transpose());
    const Matrix3 qq = (volume / duration) * (0.5 * flow.viscosity * a.dissipation() + flow.slope * product);
    springs.hessian(qq, definite ? a.positive_part(s) : s, *hessian);
  }
  return volume * duration * flow.potential;
}

void Membrane::follow(const Unknowns& u, const Unknowns& step) {
  if (flows_.newtonian())
    return;
  const auto& triangles = mesh_->triangles;
  std::vector<Vector3> next(triangles.size());
  each_in_parallel(triangles.size(), [&](std::size_t t) {
    const Corners& v = triangles[t];
    Vector3 m, dm;
    for (int k = 0; k < 3; ++k) {
      const auto from = v[(k + 1) % 3], to = v[(k + 2) % 3];
      const Vector3 e = Stage::position(u, to) - Stage::position(u, from);
      m[k] = e.squaredNorm() - reference_[t][k];
      dm[k] = 2 * e.dot(Stage::position(step, to) - Stage::position(step, from));
    }
    const FlowPoint flow = flows_.of(t).at(strain_rate(raised_[t], m, duration_[t]).squared);
    const Vector3 r = m / (2 * duration_[t]), dr = dm / (2 * duration_[t]);
    const Vector3 p = stress_.empty() ? Vector3(flow.viscosity * r) : stress_[t];
    next[t] = flow.viscosity * (r + dr) + (flow.slope / flow.viscosity * 2 * raised_[t].dissipated(r).dot(dr)) * p;
  });
  stress_ = std::move(next);
}

// Twice the potential, or V τ η γ̇².
void Membrane::add_dissipated(const Unknowns& u, std::span<double> energy) const {
  each_in_parallel(energy.size(), [&](std::size_t t) {
    const Corners& v = mesh_->triangles[t];
    const Vector3 q = squared_lengths(Stage::position(u, v[0]), Stage::position(u, v[1]), Stage::position(u, v[2]));
    const Vector3 m = q - reference_[t];
    const double work = weight_[t] * m.dot(raised_[t].dissipated(m)); // with a viscosity of 1, of a flow curve
    energy[t] += flows_.newtonian() ? work : work * flows_.of(t).viscosity(strain_rate(raised_[t], m, duration_[t]));
  });
}

double Membrane::gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
  if (!flows_.newtonian())
    return curved_derivatives(i, u, gradient, nullptr, false);
  const EdgeSprings springs(u);
  const Vector3 m = springs.squared_lengths() - reference_[i];
  const Vector3 s = weight_[i] * raised_[i].dissipated(m);
  springs.gradient(s, gradient);
  return 0.5 * m.dot(s);
}

double Membrane::derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                             bool definite) const {
  if (!flows_.newtonian())
    return curved_derivatives(i, u, gradient, &hessian, definite);
  const EdgeSprings springs(u);
  const Vector3 m = springs.squared_lengths() - reference_[i];
  const RaisedMetric& a = raised_[i];
  const Matrix3 c = weight_[i] * a.dissipation();
  const Vector3 s = c * m; // ∂W/∂q [N/m]
  springs.gradient(s, gradient);
  springs.hessian(c, definite ? a.positive_part(s) : s, hessian);
  return 0.5 * m.dot(s);
}

} // namespace sheet
