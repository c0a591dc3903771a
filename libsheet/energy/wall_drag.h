// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the wall on a layer that flows along it. A layer of thickness h between a wall without slip, or with the slip
// length b, and a free face moves with its depth-averaged velocity u and is dragged by 3 μ u/(h + 3 b) [Pa] [Huppert
// 1982; Oron, Davis and Bankoff 1997, section II.B]. For each corner of a triangle that touches
//   W = (cos²φ Â/3 + sin²φ F) 3 μ |P (x - x̄)|² / (2 τ (ĥ + 3 b)),   F = Σ l ĥ/2,
// φ the angle between triangle and wall at the start of the step, Â and ĥ predicted for the end of the stage, P along
// the wall, x̄ where the corner had been carried by the wall (WallSite::carried). F is the foot on which a triangle
// stands, of its edges there whose both ends touch, of the length l: belts carry along what stands on them.
#pragma once
#include "libsheet/base/each.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/walls.h"

namespace sheet {

class WallDrag {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  [[nodiscard]] const char* name() const { return "drag of walls"; }
  [[nodiscard]] std::size_t size() const { return stage_ ? stage_->start->volumes.size() : 0; }
  void begin(const Stage& stage) {
    stage_ = &stage;
    stiffness_.assign(stage.sites.empty() ? 0 : size(), {});
    each_in_parallel(stiffness_.size(), [&](std::size_t i) {
      const Corners& corners = stage.start->mesh->triangles[i];
      const double area = stage.raised[i].area(), thickness = stage.start->volumes[i] / area;
      for (std::size_t c = 0; c < 3; ++c)
        if (const WallSite* site = site_at(stage, corners[c]); site != nullptr && site->slip_length != free_slip) {
          const double lies = lying(stage, i, *site), foot = thickness / 2 * length_on_wall(stage, corners, c);
          stiffness_[i][c] = (lies * area + (1 - lies) * 3 * foot) * stage.viscosity[i] /
                             (stage.duration * (thickness + 3 * site->slip_length));
        }
    });
  }

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

  void add_wall_forces(const Unknowns& u, std::span<Vector3> force) const {
    const auto& triangles = stage_->start->mesh->triangles;
    for (std::size_t t = 0; t < stiffness_.size(); ++t) {
      VectorN<9> x, pull;
      for (Eigen::Index c = 0; c < 3; ++c)
        x.segment<3>(3 * c) = stage_->position(u, triangles[t][static_cast<std::size_t>(c)]);
      (void)gradient(t, x, pull);
      for (Eigen::Index c = 0; c < 3; ++c)
        force[triangles[t][static_cast<std::size_t>(c)]] -= pull.segment<3>(3 * c);
    }
  }

private:
  // Of the edges at a corner whose both ends touch its wall, at the start of the step [m].
  static double length_on_wall(const Stage& stage, const Corners& corners, std::size_t corner) {
    const auto& x = stage.start->positions;
    double length = 0;
    for (std::size_t other = 1; other < 3; ++other) {
      const std::uint32_t v = corners[corner], w = corners[(corner + other) % 3];
      if (const WallSite* site = site_at(stage, w); site != nullptr && site->wall == site_at(stage, v)->wall)
        length += (x[w] - x[v]).norm();
    }
    return length;
  }

  template <class Visit> void each_corner(std::size_t i, const VectorN<9>& u, Visit&& visit) const {
    for (std::size_t c = 0; c < 3 && !stiffness_.empty(); ++c) {
      if (stiffness_[i][c] == 0)
        continue;
      const WallSite* site = site_at(*stage_, stage_->start->mesh->triangles[i][c]);
      const Vector3 moved = u.segment<3>(3 * static_cast<Eigen::Index>(c)) - site->carried;
      visit(static_cast<int>(c), Vector3(moved - site->normal.dot(moved) * site->normal), site->normal,
            stiffness_[i][c]);
    }
  }

  const Stage* stage_ = nullptr;
  std::vector<std::array<double, 3>> stiffness_; // of each corner of each triangle [N/m]; empty where nothing touches
};

} // namespace sheet
