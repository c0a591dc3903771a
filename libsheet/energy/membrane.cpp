// SPDX-License-Identifier: GPL-3.0-or-later
// Viscous stretching, written in squared edge lengths: with m = q(x) - q̄, W = V μ/(4τ) mᵀ C m.
#include "libsheet/energy/membrane.h"

#include "libsheet/energy/edge_springs.h"

namespace sheet {

void Membrane::begin(const Stage& stage) {
  raised_ = stage.raised;
  const auto& triangles = stage.start->mesh->triangles;
  reference_.resize(triangles.size());
  weight_.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Corners& v = triangles[t];
    const auto lengths = [&](const Unknowns& u) {
      return squared_lengths(stage.position(u, v[0]), stage.position(u, v[1]), stage.position(u, v[2]));
    };
    const Vector3 start = lengths(stage.begin);
    const double rate = stage.viscosity[t] / (4 * stage.duration);
    weight_[t] = 2 * rate * stage.start->volumes[t] * stage.stiffening(t);
    reference_[t] = stage.previous ? Vector3(start + stage.ratio * (lengths(*stage.previous) - start)) : start;
  }
}

double Membrane::value(std::size_t i, const VectorN<9>& u) const {
  const Vector3 m = squared_lengths(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)) - reference_[i];
  const RaisedMetric& a = raised_[i];
  const double trace = a.trace.dot(m);
  return weight_[i] * (trace * trace - form_determinant(m) / a.determinant);
}

double Membrane::gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
  const EdgeSprings springs(u);
  const Vector3 m = springs.squared_lengths() - reference_[i];
  const Vector3 s = weight_[i] * raised_[i].dissipated(m);
  springs.gradient(s, gradient);
  return 0.5 * m.dot(s);
}

double Membrane::derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                             bool definite) const {
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
