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
  // springs: outlive the term; inertia: it is modelled; adhesion: the springs pull, too; flow: layers do.
  ContactDamping(std::span<const ContactSpring> springs, bool inertia, bool adhesion, bool flow)
      : springs_(springs), rests_(springs, flow), inertia_(inertia), adhesion_(adhesion) {}
  [[nodiscard]] const char* name() const { return "contact damping"; }
  [[nodiscard]] std::size_t size() const { return springs_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return springs_[i].vertices; }
  void begin(const Stage& stage);

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const {
    const Way way(*this, i, u);
    return 0.5 * (way.normal * way.across * way.across + dampers_[i].tangential * way.along.squaredNorm());
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const {
    const Way way(*this, i, u);
    const Vector3& n = springs_[i].normal;
    const Vector3 force = way.normal * way.across * n + dampers_[i].tangential * way.along;
    const Matrix3 nn = n * n.transpose();
    const Matrix3 stiffness = way.normal * nn + dampers_[i].tangential * (Matrix3::Identity() - nn);
    const auto& w = springs_[i].weights;
    for (std::size_t a = 0; a < 4; ++a) {
      const auto row = static_cast<Eigen::Index>(3 * a);
      gradient.segment<3>(row) = w[a] * force;
      for (std::size_t b = 0; b < 4; ++b)
        hessian.block<3, 3>(row, static_cast<Eigen::Index>(3 * b)) = w[a] * w[b] * stiffness;
    }
    rests_.add_derivatives(i, u, way.normal, way.across, gradient, hessian, definite);
    return 0.5 * (way.normal * way.across * way.across + dampers_[i].tangential * way.along.squaredNorm());
  }

private:
  struct Damper {
    Vector3 before = Vector3::Zero();  // Σ w_i x̄_i [m]
    double normal = 0, tangential = 0; // c/τ [N/m]
  };

  // e, across the layers beyond what their thickness makes of it, and the stiffness that it meets there.
  struct Way {
    double across, normal;
    Vector3 along;
    Way(const ContactDamping& d, std::size_t i, const VectorN<12>& u) {
      const Vector3 e = weighted_sum(d.springs_[i].weights, u) - d.dampers_[i].before;
      const double apart = d.springs_[i].normal.dot(e);
      along = e - apart * d.springs_[i].normal;
      across = apart - (d.rests_.longer(i, u) - d.rests_.longer_before(i));
      normal = d.adhesion_ || across < 0 ? d.dampers_[i].normal : 0;
    }
  };

  std::span<const ContactSpring> springs_;
  SpringRests rests_;
  bool inertia_, adhesion_;
  std::vector<Damper> dampers_;
};

} // namespace sheet
