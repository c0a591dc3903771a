// SPDX-License-Identifier: GPL-3.0-or-later
// Contact springs between near features of a sheet [Batty et al. 2012, section 3.5]: c = Σ w_i x_i is the vector from
// one feature to the other (vertex and triangle: weights 1, -λ0, -λ1, -λ2; edge and edge: λ, 1-λ, -κ, κ-1; they sum to
// zero), and
//   W = k_n/2 (n·c - d)² + k_t/2 |(1 - n nᵀ)(c - c0)|²,
// n fixed normal, d rest distance (spring_rests.h) [m], c0 the anchored offset [m], stiffnesses k_n, k_t [N/m]. Without
// adhesion the normal part acts only while n·c < d.
#pragma once
#include "libsheet/energy/spring_rests.h"

namespace sheet {

class Contact {
public:
  static constexpr Stencil stencil = Stencil::four;
  static constexpr Kind kind = Kind::elastic;
  // springs: outlive the term; adhesion: they pull, too; else they only push; flow: layers do.
  Contact(std::span<const ContactSpring> springs, bool adhesion, bool flow)
      : springs_(springs), rests_(springs, flow), adhesion_(adhesion) {}
  [[nodiscard]] const char* name() const { return "contact"; }
  [[nodiscard]] std::size_t size() const { return springs_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return springs_[i].vertices; }
  void begin(const Stage& stage) { rests_.begin(stage); }

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const {
    const ContactSpring& s = springs_[i];
    return s.energy(weighted_sum(s.weights, u), adhesion_, rests_.longer(i, u));
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const {
    const ContactSpring& s = springs_[i];
    const Vector3 c = weighted_sum(s.weights, u), slide = s.slide(c);
    const double longer = rests_.longer(i, u), gap = s.gap(c) - longer, k = s.normal_stiffness(gap, adhesion_);
    const Vector3 force = k * gap * s.normal + s.stiffness[1] * slide;
    const Matrix3 nn = s.normal * s.normal.transpose();
    const Matrix3 stiffness = k * nn + s.stiffness[1] * (Matrix3::Identity() - nn);
    for (int a = 0; a < 4; ++a) {
      const double wa = s.weights[static_cast<std::size_t>(a)];
      gradient.segment<3>(3 * a) = wa * force;
      for (int b = 0; b < 4; ++b)
        hessian.block<3, 3>(3 * a, 3 * b) = (wa * s.weights[static_cast<std::size_t>(b)]) * stiffness;
    }
    rests_.add_derivatives(i, u, k, gap, gradient, hessian, definite);
    return s.energy(c, adhesion_, longer);
  }

private:
  std::span<const ContactSpring> springs_;
  SpringRests rests_;
  bool adhesion_;
};

} // namespace sheet
