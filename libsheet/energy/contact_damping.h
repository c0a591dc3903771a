// SPDX-License-Identifier: GPL-3.0-or-later
// What keeps layers that touch from bouncing and swaying on their springs (contact.h). For each contact spring of the
// area A and the stiffnesses k_n, k_t, between layers of the mean thickness h,
//   W = (c_n (n·e - d + d̄)² + c_t |P e|²)/(2 τ),   e = Σ w_i (x_i - x̄_i),
//   c_n = μ h/2 + √(2 k_n A ρ h),   c_t = √(2 k_t A ρ h)   [N s/m],
// n its normal, d its rest distance (spring_rests.h), P along the layers, x̄, d̄ at the start of the step, in a second
// stage extrapolated from the first. μ h/2 resists as the sheet itself does when it is stretched, μ of two liquids
// 2/(1/μ + 1/μ'), as one is behind the other; the roots, with inertia only, damp two free layers critically. Neither
// depends on the step. Without adhesion, across the layers only approach is damped.
#pragma once
#include "libsheet/energy/contact.h"

namespace sheet {

class ContactDamping {
public:
  static constexpr Stencil stencil = Stencil::four;
  static constexpr bool external = true;
  // rests: Contact begins them; inertia: it is modelled; adhesion: the springs pull, too.
  ContactDamping(std::shared_ptr<const SpringRests> rests, bool inertia, bool adhesion)
      : rests_(std::move(rests)), inertia_(inertia), adhesion_(adhesion) {}
  [[nodiscard]] const char* name() const { return "contact damping"; }
  [[nodiscard]] std::size_t size() const { return rests_->springs().size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return spring(i).vertices; }
  void begin(const Stage& stage);

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const { return Way(*this, i, u).work(); }

  double gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const {
    const Way way(*this, i, u);
    way.set_gradient(gradient);
    return way.work();
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const {
    const Way way(*this, i, u);
    way.set_gradient(gradient);
    way.set_hessian(hessian, definite);
    return way.work();
  }

private:
  struct Damper {
    Vector3 before = Vector3::Zero();  // Σ w_i x̄_i [m]
    double normal = 0, tangential = 0; // c/τ [N/m]
  };
  [[nodiscard]] const ContactSpring& spring(std::size_t i) const { return rests_->springs()[i]; }

  // e, across the layers beyond what their thickness makes of it, and the stiffnesses that it meets.
  struct Way {
    const ContactSpring& spring;
    LongerRest longer;
    double across, normal, tangential;
    Vector3 along;
    Way(const ContactDamping& d, std::size_t i, const VectorN<12>& u)
        : spring(d.spring(i)), longer(d.rests_->longer(i, u)), tangential(d.dampers_[i].tangential) {
      const Vector3 e = weighted_sum(spring.weights, u) - d.dampers_[i].before;
      const double apart = spring.normal.dot(e);
      along = e - apart * spring.normal;
      across = apart - (longer.value - d.rests_->longer_before(i));
      normal = d.adhesion_ || across < 0 ? d.dampers_[i].normal : 0;
    }
    [[nodiscard]] double work() const { return 0.5 * (normal * across * across + tangential * along.squaredNorm()); }
    void set_gradient(VectorN<12>& gradient) const {
      gradient = spread(spring.weights, normal * across * spring.normal + tangential * along);
      longer.add_to_gradient(normal * across, gradient);
    }
    void set_hessian(MatrixN<12>& hessian, bool definite) const {
      set_along(spring, tangential, hessian);
      longer.add_to_hessian(normal, normal * across, spread(spring.weights, spring.normal), hessian, definite);
    }
  };

  std::shared_ptr<const SpringRests> rests_;
  bool inertia_, adhesion_;
  std::vector<Damper> dampers_;
};

} // namespace sheet
