// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of one stage: W = m |x - x̂|² / (2 τ²) for each vertex, x̂ (Stage::inertial) where it would go without force
// [m], m a third of the mass ρ V of each triangle at it [kg] (lumped). Where inertia gives way to force in another time
// than the stage's (Stage::inertial_time), that takes the place of one τ.
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

class Inertia {
public:
  static constexpr Stencil stencil = Stencil::vertex;
  static constexpr Kind kind = Kind::inertial;
  [[nodiscard]] const char* name() const { return "inertia"; }
  [[nodiscard]] std::size_t size() const { return stage_ ? stage_->vertices() : 0; }
  void begin(const Stage& stage) { stage_ = &stage; }

  [[nodiscard]] double value(std::size_t i, const Vector3& u) const {
    return 0.5 * weight(i) * (u - stage_->inertial[i]).squaredNorm();
  }

  double gradient(std::size_t i, const Vector3& u, Vector3& gradient) const {
    gradient = weight(i) * (u - stage_->inertial[i]);
    return value(i, u);
  }

  double derivatives(std::size_t i, const Vector3& u, Vector3& g, Matrix3& hessian, bool) const {
    hessian = weight(i) * Matrix3::Identity();
    return gradient(i, u, g);
  }

private:
  [[nodiscard]] double weight(std::size_t i) const {
    return stage_->liquid.density * stage_->vertex_volumes[i] / (stage_->duration * stage_->inertial_time);
  }

  const Stage* stage_ = nullptr;
};

} // namespace sheet
