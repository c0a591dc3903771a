// SPDX-License-Identifier: GPL-3.0-or-later
// Contact springs between near features of a sheet [Batty et al. 2012, section 3.5]: c = Σ w_i x_i is the vector from
// one feature to the other (vertex and triangle: weights 1, -λ0, -λ1, -λ2; edge and edge: λ, 1-λ, -κ, κ-1; they sum to
// zero), and
//   W = k_n/2 (n·c - d)² + k_t/2 |(1 - n nᵀ)(c - c0)|²,
// n fixed normal, d rest distance [m], c0 the anchored offset [m], stiffnesses k_n, k_t [N/m]. Without adhesion the
// normal part acts only while n·c < d.
#pragma once
#include "libsheet/energy/element.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

class Contact {
public:
  static constexpr Stencil stencil = Stencil::four;
  static constexpr Kind kind = Kind::elastic;
  // adhesion: they pull, too; else they only push.
  Contact(std::vector<ContactSpring> springs, bool adhesion) : springs_(std::move(springs)), adhesion_(adhesion) {}
  [[nodiscard]] const char* name() const { return "contact"; }
  [[nodiscard]] std::size_t size() const { return springs_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return springs_[i].vertices; }
  void begin(const Stage&) {}

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const {
    const ContactSpring& s = springs_[i];
    const Vector3 c = offset(s, u), slide = tangential(s, c);
    const double gap = s.normal.dot(c) - s.rest;
    return 0.5 * normal_stiffness(s, gap) * gap * gap + 0.5 * s.stiffness[1] * slide.squaredNorm();
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian, bool) const {
    const ContactSpring& s = springs_[i];
    const Vector3 c = offset(s, u), slide = tangential(s, c);
    const double gap = s.normal.dot(c) - s.rest, k = normal_stiffness(s, gap);
    const Vector3 force = k * gap * s.normal + s.stiffness[1] * slide;
    const Matrix3 nn = s.normal * s.normal.transpose();
    const Matrix3 stiffness = k * nn + s.stiffness[1] * (Matrix3::Identity() - nn);
    for (int a = 0; a < 4; ++a) {
      const double wa = s.weights[static_cast<std::size_t>(a)];
      gradient.segment<3>(3 * a) = wa * force;
      for (int b = 0; b < 4; ++b)
        hessian.block<3, 3>(3 * a, 3 * b) = (wa * s.weights[static_cast<std::size_t>(b)]) * stiffness;
    }
    return 0.5 * k * gap * gap + 0.5 * s.stiffness[1] * slide.squaredNorm();
  }

private:
  static Vector3 offset(const ContactSpring& s, const VectorN<12>& u) {
    return s.weights[0] * u.segment<3>(0) + s.weights[1] * u.segment<3>(3) + s.weights[2] * u.segment<3>(6) +
           s.weights[3] * u.segment<3>(9);
  }
  static Vector3 tangential(const ContactSpring& s, const Vector3& c) {
    const Vector3 d = c - s.anchor;
    return d - s.normal.dot(d) * s.normal;
  }
  [[nodiscard]] double normal_stiffness(const ContactSpring& s, double gap) const {
    return adhesion_ || gap < 0 ? s.stiffness[0] : 0;
  }

  std::vector<ContactSpring> springs_;
  bool adhesion_;
};

} // namespace sheet
