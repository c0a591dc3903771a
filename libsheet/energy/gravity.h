// SPDX-License-Identifier: GPL-3.0-or-later
// Weight: W = -m g·(x - x0) for each vertex, m a third of the mass ρ V of each triangle at it; g in m/s², x0 the start
// of the step.
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

class Gravity {
public:
  static constexpr Stencil stencil = Stencil::vertex;
  static constexpr bool external = true;
  static constexpr bool linear = true;
  explicit Gravity(const Vector3& gravity) : gravity_(gravity) {}
  [[nodiscard]] const char* name() const { return "gravity"; }
  [[nodiscard]] std::size_t size() const { return volumes_.size(); }
  void begin(const Stage& stage) {
    volumes_ = stage.vertex_volumes;
    start_ = stage.start->positions;
    numbers_ = stage.vertex_liquids;
    weights_.clear();
    for (const StageLiquid& of : stage.liquids)
      weights_.emplace_back(of.liquid.density * gravity_);
  }

  [[nodiscard]] double value(std::size_t i, const Vector3& u) const {
    return -volumes_[i] * weight(i).dot(u - start_[i]);
  }

  double gradient(std::size_t i, const Vector3& u, Vector3& gradient) const {
    gradient = -volumes_[i] * weight(i);
    return value(i, u);
  }

  double derivatives(std::size_t i, const Vector3& u, Vector3& g, Matrix3& hessian, bool) const {
    hessian.setZero();
    return gradient(i, u, g);
  }

private:
  [[nodiscard]] const Vector3& weight(std::size_t i) const { return weights_[numbers_.empty() ? 0 : numbers_[i]]; }

  Vector3 gravity_;                    // [m/s²]
  std::vector<Vector3> weights_;       // of a cubic metre of each liquid [N/m³]
  std::vector<std::uint32_t> numbers_; // Stage::vertex_liquids
  std::vector<double> volumes_;        // of the vertices [m³]
  std::vector<Vector3> start_;         // x0 [m]
};

} // namespace sheet
