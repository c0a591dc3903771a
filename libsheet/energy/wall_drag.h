// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the wall on a layer that flows along it. A layer of thickness h between a wall without slip, or with the slip
// length b, and a free face moves with its depth-averaged velocity u and is dragged by 3 μ u/(h + 3 b) [Pa] [Huppert
// 1982; Oron, Davis and Bankoff 1997, section II.B]. For each corner of a triangle that touches
//   W = (Â/3) 3 μ |P (x - x̄)|² / (2 τ (ĥ + 3 b)),
// Â and ĥ predicted for the end of the stage, P along the wall, x̄ where the corner had been carried by the wall
// (WallSite::carried).
#pragma once
#include "libsheet/energy/element.h"
#include "libsheet/energy/walls.h"

namespace sheet {

class WallDrag {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  explicit WallDrag(double viscosity) : viscosity_(viscosity) {}
  [[nodiscard]] const char* name() const { return "drag of walls"; }
  [[nodiscard]] std::size_t size() const { return stage_ ? stage_->start->volumes.size() : 0; }
  void begin(const Stage& stage) { stage_ = &stage; }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    each_corner(i, u, [&](int, const Vector3& slid, const Vector3&, double stiffness) {
      sum += 0.5 * stiffness * slid.squaredNorm();
    });
    return sum;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    double sum = 0;
    gradient.setZero();
    each_corner(i, u, [&](int c, const Vector3& slid, const Vector3&, double stiffness) {
      gradient.segment<3>(3 * c) = stiffness * slid;
      sum += 0.5 * stiffness * slid.squaredNorm();
    });
    return sum;
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& g, MatrixN<9>& hessian, bool) const {
    hessian.setZero();
    each_corner(i, u, [&](int c, const Vector3&, const Vector3& normal, double stiffness) {
      hessian.block<3, 3>(3 * c, 3 * c) = stiffness * (Matrix3::Identity() - normal * normal.transpose());
    });
    return gradient(i, u, g);
  }

private:
  template <class Visit> void each_corner(std::size_t i, const VectorN<9>& u, Visit&& visit) const {
    if (stage_->sites.empty())
      return;
    const Corners& corners = stage_->start->mesh->triangles[i];
    const double area = stage_->raised[i].area(), thickness = stage_->start->volumes[i] / area;
    for (int c = 0; c < 3; ++c) {
      const WallSite* site = site_at(*stage_, corners[static_cast<std::size_t>(c)]);
      if (site == nullptr || site->slip_length == free_slip)
        continue;
      const Vector3 moved = u.segment<3>(3 * c) - site->carried;
      const double stiffness = area * viscosity_ / (stage_->duration * (thickness + 3 * site->slip_length));
      visit(c, Vector3(moved - site->normal.dot(moved) * site->normal), site->normal, stiffness);
    }
  }

  double viscosity_;
  const Stage* stage_ = nullptr;
};

} // namespace sheet
