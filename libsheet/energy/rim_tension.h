// SPDX-License-Identifier: GPL-3.0-or-later
// Surface tension of free rims: W = c γ h l = c γ V l/A for each side of a triangle that is one, l its length, c
// between π/4 and 1 (geometry/faces.h says of what form that is the area). It holds a rim apart that tension draws
// together. Which sides count, and to which part, is the model's (model.h); an element is a triangle.
#pragma once
#include <cmath>

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
    volumes_ = stage.start->volumes;
    tension_.resize(parts_.size());
    for (std::size_t t = 0; t < parts_.size(); ++t)
      tension_[t] = stage.surface_tension(t);
  }

  [[nodiscard]] bool idle(std::size_t i) const { return parts_[i][0] + parts_[i][1] + parts_[i][2] == 0; }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    double sum = 0;
    if (!idle(i))
      each_side(i, triangle(u), [&](int, const Side& side) { sum += side.value; });
    return sum;
  }

  double gradient(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient) const {
    gradient.setZero();
    if (idle(i))
      return 0;
    const TriangleArea a = triangle(u);
    double sum = 0, by_area = 0;
    each_side(i, a, [&](int k, const Side& side) {
      const Vector3 along = side.by_length / (side.length * side.length) * a.edge[k];
      gradient.segment<3>(end(k)) += along;
      gradient.segment<3>(start(k)) -= along;
      by_area += side.by_area / a.area;
      sum += side.value;
    });
    for (int k = 0; k < 3; ++k)
      gradient.segment<3>(3 * k) += by_area * a.gradient(k);
    return sum;
  }

  // With α = ∇ ln A, λ = ∇ ln l: ∇∇ ln A = ∇∇A/A - α αᵀ, ∇∇ ln l = ∇∇l/l - λ λᵀ. The positive form keeps the positive
  // part of what is quadratic in α and λ, and ∇∇l.
  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    gradient.setZero();
    hessian.setZero();
    if (idle(i))
      return 0;
    const TriangleArea a = triangle(u);
    VectorN<9> of_area;
    of_area << a.gradient(0), a.gradient(1), a.gradient(2);
    of_area /= a.area;
    double sum = 0, by_area = 0;
    each_side(i, a, [&](int k, Side side) {
      const Vector3 along = a.edge[k] / side.length;
      VectorN<9> of_length = VectorN<9>::Zero();
      of_length.segment<3>(end(k)) = along / side.length;
      of_length.segment<3>(start(k)) = -along / side.length;
      gradient += side.by_area * of_area + side.by_length * of_length;
      if (definite) {
        side.keep_positive();
      } else {
        side.area2 -= side.by_area;
        side.length2 -= side.by_length;
      }
      hessian += side.area2 * of_area * of_area.transpose() + side.length2 * of_length * of_length.transpose() +
                 side.mixed * (of_area * of_length.transpose() + of_length * of_area.transpose());
      const Matrix3 turn =
          side.by_length / (side.length * side.length) * (Matrix3::Identity() - along * along.transpose());
      hessian.block<3, 3>(end(k), end(k)) += turn;
      hessian.block<3, 3>(start(k), start(k)) += turn;
      hessian.block<3, 3>(end(k), start(k)) -= turn;
      hessian.block<3, 3>(start(k), end(k)) -= turn;
      by_area += side.by_area;
      sum += side.value;
    });
    if (!definite)
      hessian += by_area / a.area * a.hessian(true);
    return sum;
  }

private:
  // W of one side, and its derivatives by ln A and ln l.
  struct Side {
    Side(double tension, double volume, double area, double l) : length(l) {
      const RimSide side(2 * area * area / (l * volume));
      const double flat = tension * volume * l / area;
      value = flat * side.c;
      by_area = flat * (2 * side.c1 - side.c);
      by_length = flat * (side.c - side.c1); // never negative
      area2 = flat * (side.c + 4 * side.c2);
      length2 = flat * (side.c - side.c1 + side.c2);
      mixed = flat * (side.c1 - side.c - 2 * side.c2);
    }
    // What is positive of the second ones.
    void keep_positive() {
      if (area2 * length2 >= mixed * mixed)
        return;
      const double half = (area2 - length2) / 2, root = std::hypot(half, mixed), most = (area2 + length2) / 2 + root;
      const double cosine2 = (1 + half / root) / 2; // of the direction of the greater one from ln A, squared
      area2 = most * cosine2;
      length2 = most * (1 - cosine2);
      mixed *= most / (2 * root);
    }
    double length, value, by_area, by_length, area2, length2, mixed;
  };

  static TriangleArea triangle(const VectorN<9>& u) { return {u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)}; }
  // Where edge k of a triangle begins and ends among its unknowns.
  static int start(int k) { return 3 * ((k + 1) % 3); }
  static int end(int k) { return 3 * ((k + 2) % 3); }

  template <class Visit> void each_side(std::size_t i, const TriangleArea& a, Visit&& visit) const {
    for (int k = 0; k < 3; ++k)
      if (const double part = parts_[i][static_cast<std::size_t>(k)]; part > 0)
        visit(k, Side(part * tension_[i], volumes_[i], a.area, a.edge[k].norm()));
  }

  std::vector<std::array<double, 3>> parts_; // of the sides of triangles
  std::vector<double> volumes_, tension_;    // [m³], [N/m]
};

} // namespace sheet
