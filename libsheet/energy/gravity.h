// SPDX-License-Identifier: GPL-3.0-or-later
// Weight: W = -m g·(x - x0), a third of each triangle's mass ρ V at each of its corners; g in m/s², x0 the start of the
// step.
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

class Gravity {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr bool linear = true;
  Gravity(double density, const Vector3& gravity) : weight_(density / 3 * gravity) {}
  [[nodiscard]] const char* name() const { return "gravity"; }
  [[nodiscard]] std::size_t size() const { return stage_ ? stage_->start->volumes.size() : 0; }
  void begin(const Stage& stage) { stage_ = &stage; }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    const Corners& v = stage_->start->mesh->triangles[i];
    const auto& x = stage_->start->positions;
    const Vector3 moved = (u.segment<3>(0) - x[v[0]]) + (u.segment<3>(3) - x[v[1]]) + (u.segment<3>(6) - x[v[2]]);
    return -stage_->start->volumes[i] * weight_.dot(moved);
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    const Vector3 f = -stage_->start->volumes[i] * weight_;
    gradient << f, f, f;
    return value(i, u);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& g, MatrixN<9>& hessian, bool) const {
    hessian.setZero();
    return gradient(i, u, g);
  }

private:
  Vector3 weight_; // of a cubic metre, a third [N/m³]
  const Stage* stage_ = nullptr;
};

} // namespace sheet
