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
  static constexpr bool external = true;
  static constexpr Kind kind = Kind::inertial;
  [[nodiscard]] const char* name() const { return "inertia"; }
  [[nodiscard]] std::size_t size() const { return weight_.size(); }
  void begin(const Stage& stage) {
    free_ = stage.inertial;
    weight_.resize(stage.vertices());
    for (std::size_t v = 0; v < weight_.size(); ++v)
      weight_[v] = stage.liquid_at(v).liquid.density * stage.vertex_volumes[v] / (stage.duration * stage.inertial_time);
  }

  [[nodiscard]] double value(std::size_t i, const Vector3& u) const {
    return 0.5 * weight_[i] * (u - free_[i]).squaredNorm();
  }

  double gradient(std::size_t i, const Vector3& u, Vector3& gradient) const {
    gradient = weight_[i] * (u - free_[i]);
    return value(i, u);
  }

  double derivatives(std::size_t i, const Vector3& u, Vector3& g, Matrix3& hessian, bool) const {
    hessian = weight_[i] * Matrix3::Identity();
    return gradient(i, u, g);
  }

private:
  std::vector<Vector3> free_;  // x̂ [m]
  std::vector<double> weight_; // m/τ² [N/m]
};

} // namespace sheet
