// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet that floats on a heavy bath: the hydrostatic pressure -ρ g d on its lower side, d the height [m] above the
// bath's level, as the potential (ρ g/2) ∫ d² dA of the horizontally projected area [Batty et al. 2012, section 4]:
//   W = (ρ g/12) A_z (d0² + d1² + d2² + d0 d1 + d1 d2 + d2 d0),   A_z = k·(x1-x0)×(x2-x0)/2,   k upwards.
// The normals must point upwards. ρ in kg/m³, g in m/s².
#pragma once
#include "libsheet/energy/element.h"

namespace sheet {

class Bath {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  // gravity [m/s²]; level: height of the rest plane along the upward direction [m].
  Bath(double density, const Vector3& gravity, double level)
      : weight_(density * gravity.norm() / 12), up_(-gravity.normalized()), level_(level) {}
  [[nodiscard]] const char* name() const { return "bath"; }
  [[nodiscard]] std::size_t size() const { return count_; }
  void begin(const Stage& stage) { count_ = stage.start->mesh->triangles.size(); }

  [[nodiscard]] double value(std::size_t, const VectorN<9>& u) const {
    const Parts p(*this, u);
    return weight_ * p.area * p.square;
  }

  double derivatives(std::size_t, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian, bool definite) const {
    const Parts p(*this, u);
    gradient = weight_ * (p.square * p.by_area + p.area * p.by_square);
    const Matrix3 upright = (weight_ * (definite ? std::max(0.0, p.area) : p.area)) * (up_ * up_.transpose());
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        hessian.block<3, 3>(3 * a, 3 * b) = (a == b ? 2.0 : 1.0) * upright;
    if (!definite) {
      const Matrix3 turn = (0.5 * weight_ * p.square) * skew(up_);
      for (int a = 0; a < 3; ++a) {
        hessian.block<3, 3>(3 * a, 3 * ((a + 2) % 3)) += turn;
        hessian.block<3, 3>(3 * a, 3 * ((a + 1) % 3)) -= turn;
      }
      hessian += weight_ * (p.by_area * p.by_square.transpose() + p.by_square * p.by_area.transpose());
    }
    return weight_ * p.area * p.square;
  }

private:
  struct Parts {
    double area, square;
    VectorN<9> by_area, by_square;
    Parts(const Bath& bath, const VectorN<9>& u) {
      const Vector3& k = bath.up_;
      const Vector3 x[3] = {u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)};
      const double d[3] = {k.dot(x[0]) - bath.level_, k.dot(x[1]) - bath.level_, k.dot(x[2]) - bath.level_};
      const double sum = d[0] + d[1] + d[2];
      area = 0.5 * k.dot((x[1] - x[0]).cross(x[2] - x[0]));
      square = 0.5 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + sum * sum);
      for (int a = 0; a < 3; ++a) {
        by_area.segment<3>(3 * a) = 0.5 * k.cross(x[(a + 2) % 3] - x[(a + 1) % 3]);
        by_square.segment<3>(3 * a) = (d[a] + sum) * k;
      }
    }
  };

  double weight_; // ρ g/12 [N/m³]
  Vector3 up_;
  double level_;
  std::size_t count_ = 0;
};

} // namespace sheet
