// SPDX-License-Identifier: GPL-3.0-or-later
// Contact springs between near features of a sheet [Batty et al. 2012, section 3.5]: c = Σ w_i x_i is the vector from
// one feature to the other (vertex and triangle: weights 1, -λ0, -λ1, -λ2; edge and edge: λ, 1-λ, -κ, κ-1; they sum to
// zero), and
//   W = k_n/2 (n·c - d)² + k_t/2 |(1 - n nᵀ)(c - c0)|²,
// n fixed normal, d rest distance (spring_rests.h) [m], c0 the anchored offset [m], stiffnesses k_n, k_t [N/m]. Without
// adhesion the normal part acts only while n·c < d.
#pragma once
#include <memory>
#include <utility>

#include "libsheet/energy/spring_rests.h"

namespace sheet {

// The Hessian of k/2 |(1 - n nᵀ) Σ w_i u_i|².
inline void set_along(const ContactSpring& spring, double k, MatrixN<12>& hessian) {
  if (k == 0) {
    hessian.setZero();
    return;
  }
  const Matrix3 along = k * (Matrix3::Identity() - spring.normal * spring.normal.transpose());
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b)
      hessian.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) =
          (spring.weights[a] * spring.weights[b]) * along;
}

class Contact {
public:
  static constexpr Stencil stencil = Stencil::four;
  static constexpr bool external = true;
  static constexpr Kind kind = Kind::elastic;
  // adhesion: the springs pull, too; else they only push.
  Contact(std::shared_ptr<SpringRests> rests, bool adhesion) : rests_(std::move(rests)), adhesion_(adhesion) {}
  [[nodiscard]] const char* name() const { return "contact"; }
  [[nodiscard]] std::size_t size() const { return rests_->springs().size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return spring(i).vertices; }
  void begin(const Stage& stage) { rests_->begin(stage); }

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const {
    return spring(i).energy(weighted_sum(spring(i).weights, u), adhesion_, rests_->longer(i, u).value);
  }

  double gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const {
    const Pull pull(*this, i, u);
    pull.set_gradient(gradient);
    return spring(i).energy(pull.offset, adhesion_, pull.longer.value);
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const {
    const Pull pull(*this, i, u);
    pull.set_gradient(gradient);
    pull.set_hessian(hessian, definite);
    return spring(i).energy(pull.offset, adhesion_, pull.longer.value);
  }

private:
  [[nodiscard]] const ContactSpring& spring(std::size_t i) const { return rests_->springs()[i]; }

  struct Pull {
    const ContactSpring& spring;
    Vector3 offset;
    LongerRest longer;
    double gap, stiffness; // across the layers
    Pull(const Contact& c, std::size_t i, const VectorN<12>& u)
        : spring(c.spring(i)), offset(weighted_sum(spring.weights, u)), longer(c.rests_->longer(i, u)),
          gap(spring.gap(offset) - longer.value), stiffness(spring.normal_stiffness(gap, c.adhesion_)) {}

    void set_gradient(VectorN<12>& gradient) const {
      gradient = spread(spring.weights, stiffness * gap * spring.normal + spring.stiffness[1] * spring.slide(offset));
      longer.add_to_gradient(stiffness * gap, gradient);
    }
    void set_hessian(MatrixN<12>& hessian, bool definite) const {
      set_along(spring, spring.stiffness[1], hessian);
      longer.add_to_hessian(stiffness, stiffness * gap, spread(spring.weights, spring.normal), hessian, definite);
    }
  };

  std::shared_ptr<SpringRests> rests_;
  bool adhesion_;
};

} // namespace sheet
