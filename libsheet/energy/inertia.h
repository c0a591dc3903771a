// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of one stage: W = |x - x̂|²_M / (2 τ²), x̂ (Stage::inertial) where the vertices would go without force [m], M
// from each triangle's mass ρ V [kg]: a third at each corner (lumped), or the linear finite element's (1 + δ_ij)/12
// (consistent).
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

enum class Mass { lumped, consistent };

class Inertia {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::inertial;
  Inertia(double density, Mass mass) : density_(density), mass_(mass) {}
  [[nodiscard]] const char* name() const { return "inertia"; }
  [[nodiscard]] std::size_t size() const { return stage_ ? stage_->start->volumes.size() : 0; }
  void begin(const Stage& stage) { stage_ = &stage; }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    const VectorN<9> d = offset(i, u);
    return 0.5 * d.dot(force(i, d));
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    const VectorN<9> d = offset(i, u);
    gradient = force(i, d);
    return 0.5 * d.dot(gradient);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& g, MatrixN<9>& hessian, bool) const {
    const double energy = gradient(i, u, g);
    hessian.setZero();
    const double same = weight(i) * (mass_ == Mass::lumped ? 1.0 / 3 : 1.0 / 6);
    const double other = mass_ == Mass::lumped ? 0.0 : weight(i) / 12;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        hessian.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(a == b ? same : other);
    return energy;
  }

private:
  [[nodiscard]] double weight(std::size_t i) const {
    return density_ * stage_->start->volumes[i] / (stage_->duration * stage_->duration);
  }
  [[nodiscard]] VectorN<9> offset(std::size_t i, const VectorN<9>& u) const {
    const Corners& v = stage_->start->mesh->triangles[i];
    VectorN<9> d;
    for (int a = 0; a < 3; ++a)
      d.segment<3>(3 * a) = u.segment<3>(3 * a) - stage_->inertial[v[a]];
    return d;
  }
  [[nodiscard]] VectorN<9> force(std::size_t i, const VectorN<9>& d) const {
    if (mass_ == Mass::lumped)
      return (weight(i) / 3) * d;
    const Vector3 sum = d.segment<3>(0) + d.segment<3>(3) + d.segment<3>(6);
    VectorN<9> f;
    for (int a = 0; a < 3; ++a)
      f.segment<3>(3 * a) = (weight(i) / 12) * (d.segment<3>(3 * a) + sum);
    return f;
  }

  double density_; // [kg/m³]
  Mass mass_;
  const Stage* stage_ = nullptr;
};

} // namespace sheet
