// SPDX-License-Identifier: GPL-3.0-or-later
// Surface tension of free rims: W = (π/4) γ h l = (π/4) γ V l/A for each side of a triangle that is one, l its length
// (geometry/faces.h says of what form that is the area). It holds a rim apart that tension draws together.
// Which sides count, and to which part, is the model's (model.h); an element is a triangle.
#pragma once
#include "libsheet/energy/element.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/faces.h"

namespace sheet {

class RimTension {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  // rims: of each edge of the mesh the part of it that is a free rim.
  RimTension(const std::vector<double>& rims, const Connectivity& mesh) : parts_(mesh.triangles.size()) {
    for (std::size_t t = 0; t < parts_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        parts_[t][k] = rims[mesh.triangle_edges[t][k]];
  }
  [[nodiscard]] const char* name() const { return "rim tension"; }
  [[nodiscard]] std::size_t size() const { return parts_.size(); }

  void begin(const Stage& stage) {
    weights_.resize(parts_.size());
    for (std::size_t t = 0; t < parts_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        weights_[t][k] = rim_roundness * stage.liquid.surface_tension * stage.start->volumes[t] * parts_[t][k];
  }

  [[nodiscard]] bool idle(std::size_t i) const { return weights_[i][0] + weights_[i][1] + weights_[i][2] == 0; }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    if (idle(i))
      return 0;
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights_[i][k] * a.edge[k].norm();
    return sum / a.area;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    gradient.setZero();
    if (idle(i))
      return 0;
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double length = a.edge[k].norm(), part = weights_[i][static_cast<std::size_t>(k)] / a.area;
      const Vector3 along = part / length * a.edge[k];
      gradient.segment<3>(3 * ((k + 2) % 3)) += along;
      gradient.segment<3>(3 * ((k + 1) % 3)) -= along;
      sum += part * length;
    }
    for (int k = 0; k < 3; ++k)
      gradient.segment<3>(3 * k) -= sum / a.area * a.gradient(k);
    return sum;
  }

  // With w = W of one side, d = ∇l/l - ∇A/A: ∇w = w d, and ∇∇w = w (d dᵀ + ∇∇l/l - ∇l ∇lᵀ/l² - ∇∇A/A + ∇A ∇Aᵀ/A²). The
  // positive form keeps w (d dᵀ + ∇∇l/l).
  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    gradient.setZero();
    hessian.setZero();
    if (idle(i))
      return 0;
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    VectorN<9> of_area;
    of_area << a.gradient(0), a.gradient(1), a.gradient(2);
    of_area /= a.area;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double part = weights_[i][static_cast<std::size_t>(k)];
      if (part == 0)
        continue;
      const double length = a.edge[k].norm(), w = part * length / a.area;
      const int from = 3 * ((k + 1) % 3), to = 3 * ((k + 2) % 3);
      const Vector3 along = a.edge[k] / length, of_length = along / length; // ∇l/l at the end
      VectorN<9> d = -of_area;
      d.segment<3>(to) += of_length;
      d.segment<3>(from) -= of_length;
      gradient += w * d;
      hessian += w * d * d.transpose();
      Matrix3 turn = Matrix3::Identity() - along * along.transpose();
      if (!definite)
        turn -= along * along.transpose();
      turn *= w / (length * length);
      hessian.block<3, 3>(to, to) += turn;
      hessian.block<3, 3>(from, from) += turn;
      hessian.block<3, 3>(to, from) -= turn;
      hessian.block<3, 3>(from, to) -= turn;
      sum += w;
    }
    if (!definite)
      hessian += sum * (of_area * of_area.transpose() - a.hessian(true) / a.area);
    return sum;
  }

private:
  std::vector<std::array<double, 3>> parts_, weights_; // of the sides of triangles; weights: w A/l [N m²]
};

} // namespace sheet
