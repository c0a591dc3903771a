// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of a bath on what slides on it, k u [Pa] at a speed u along its surface; k is the bath's viscosity over its
// depth where that is shallow and its flow is Couette's. For each corner of a triangle that starts under its surface
//   W = (Â/3) k |P (x - x̄)|²/(2 τ),
// Â predicted for the end of the stage, P along the surface, x̄ the start of the step, in a second stage extrapolated
// from the first. The bath itself rests.
#pragma once
#include <utility>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/element.h"

namespace sheet {

class BathDrag {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  // drag: k [Pa s/m]; level, reach: as in BathSurface.
  BathDrag(double drag, const Vector3& gravity, double level, std::vector<BathReach> reach = {})
      : drag_(drag), surface_(gravity, level, std::move(reach)) {}
  [[nodiscard]] const char* name() const { return "drag of a bath"; }
  [[nodiscard]] std::size_t size() const { return stiffness_.size(); }
  void begin(const Stage& stage) {
    mesh_ = stage.start->mesh;
    start_ = stage.start->positions;
    stiffness_.resize(mesh_->triangles.size());
    for (std::size_t t = 0; t < stiffness_.size(); ++t)
      stiffness_[t] = stage.raised[t].area() / 3 * drag_ / stage.duration;
    led_.resize(stage.previous != nullptr ? start_.size() : 0);
    for (std::uint32_t v = 0; v < led_.size(); ++v)
      led_[v] = stage.ratio * (Stage::position(*stage.previous, v) - start_[v]);
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c)
      sum += 0.5 * stiffness(i, c) * slid(i, c, u).squaredNorm();
    return sum;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian, bool) const {
    hessian.setZero();
    for (int c = 0; c < 3; ++c) {
      gradient.segment<3>(3 * c) = stiffness(i, c) * slid(i, c, u);
      hessian.block<3, 3>(3 * c, 3 * c) =
          stiffness(i, c) * (Matrix3::Identity() - surface_.up() * surface_.up().transpose());
    }
    return value(i, u);
  }

private:
  [[nodiscard]] std::uint32_t vertex(std::size_t i, int c) const {
    return mesh_->triangles[i][static_cast<std::size_t>(c)];
  }
  // 0 above the surface, and where another layer bears it [N/m].
  [[nodiscard]] double stiffness(std::size_t i, int c) const {
    return surface_.wets(vertex(i, c), start_[vertex(i, c)]) ? stiffness_[i] : 0;
  }
  // P (x - x̄) [m].
  [[nodiscard]] Vector3 slid(std::size_t i, int c, const VectorN<9>& u) const {
    Vector3 moved = u.segment<3>(3 * c) - start_[vertex(i, c)];
    if (!led_.empty())
      moved -= led_[vertex(i, c)];
    return moved - surface_.up().dot(moved) * surface_.up();
  }

  double drag_; // [Pa s/m]
  BathSurface surface_;
  std::shared_ptr<const Connectivity> mesh_;
  std::vector<Vector3> start_, led_; // of the vertices: where the step starts, x̄ less that; none in a first stage [m]
  std::vector<double> stiffness_;    // (Â/3) k/τ of each triangle [N/m]
};

} // namespace sheet
