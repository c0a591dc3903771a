// SPDX-License-Identifier: GPL-3.0-or-later
// Shear between layers that lie on each other and flow, in place of a spring that glues them along each other. For
// each contact spring, of the area A, between layers of thickness h below and h' above, on a wall or not (layers.h),
//   W = A μ/(2 τ) (|P e|²/depth + 3 (n·f - r + r̄)²/d),
//   e = Σ v_i (x_i - x̄_i),   f = Σ w_i (x_i - x̄_i),   d = (h + h')/2,
// n the spring's normal, r its rest distance (spring_rests.h), P along the layers, e the way of the upper layer less
// `carries` times that of the lower one, both relative to the wall: v are the spring's weights w, but for corners that
// touch one `carries` times these. x̄ is the start of the step, in a second stage extrapolated from the first, and what
// a corner does beyond its own weight counts from WallSite::carried. What this does not give back to the upper layer
// the wall takes (add_wall_forces). The second part is that of liquid which is drawn out or squeezed between the
// middles of the layers [Trouton 1906]; without it they would bounce on their springs whenever contacts change. Of a
// liquid that is not Newtonian the first part is A τ depth φ(γ̇²), γ̇ = |P e|/(τ depth) (curved_drag.h). Welds hold by
// their springs alone.
#pragma once
#include "libsheet/energy/contact.h"
#include "libsheet/energy/curved_drag.h"
#include "libsheet/energy/liquid_flows.h"

namespace sheet {

class ContactShear {
public:
  static constexpr Stencil stencil = Stencil::four;
  // rests: Contact begins them; of layers that flow.
  explicit ContactShear(std::shared_ptr<const SpringRests> rests) : rests_(std::move(rests)) {}
  [[nodiscard]] const char* name() const { return "shear of layers"; }
  [[nodiscard]] std::size_t size() const { return rests_->springs().size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const { return spring(i).vertices; }
  void begin(const Stage& stage);

  [[nodiscard]] double value(std::size_t i, const VectorN<12>& u) const {
    return drag_of(links_[i], way(i, u)).potential + Squeeze(*this, i, u).work();
  }

  double gradient(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient) const {
    const Vector3 slid = way(i, u);
    const CurvedDrag drag = drag_of(links_[i], slid);
    const Squeeze squeeze(*this, i, u);
    set_gradient(i, drag.stiffness * slid, squeeze, gradient);
    return drag.potential + squeeze.work();
  }

  double derivatives(std::size_t i, const VectorN<12>& u, VectorN<12>& gradient, MatrixN<12>& hessian,
                     bool definite) const {
    const Vector3 slid = way(i, u), &n = spring(i).normal;
    const CurvedDrag drag = drag_of(links_[i], slid);
    const Squeeze squeeze(*this, i, u);
    set_gradient(i, drag.stiffness * slid, squeeze, gradient);
    const Matrix3 along = drag.hessian(slid, Matrix3::Identity() - n * n.transpose(), own_force(i));
    const auto& v = links_[i].weights;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        hessian.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) = v[a] * v[b] * along;
    squeeze.longer.add_to_hessian(squeeze.stiffness, squeeze.stiffness * squeeze.thicker, spread(spring(i).weights, n),
                                  hessian, definite);
    return drag.potential + squeeze.work();
  }

  // See term.h.
  void follow(const Unknowns& u, const Unknowns& step);
  void rest_at(std::span<const double> rates) { flows_.rest_at(rates); }

  // What the wall takes of the shear: what the layers do not give each other.
  void add_wall_forces(const Unknowns& u, std::span<Vector3> force) const;

private:
  struct Link {
    std::array<double, 4> weights{}; // v
    Vector3 before;                  // Σ v_i x̄_i [m]
    double thickness = 0;            // n·Σ w_i x̄_i [m]
    double shear = 0, squeeze = 0;   // stiffnesses [N/m]
    double area = 0, depth = 0;      // for a flow curve [m²], [m]
    double time = 0;                 // likewise: τ, reduced by temperature (stage.h) [s]
    std::uint32_t liquid = 0;        // by its number
  };

  [[nodiscard]] CurvedDrag drag_of(const Link& link, const Vector3& slid) const {
    const FlowCurve& curve = flows_.numbered(link.liquid);
    if (curve.newtonian() || link.area == 0)
      return {0.5 * link.shear * slid.squaredNorm(), link.shear, 0};
    const double per = 1 / (link.time * link.depth);
    const FlowPoint flow = curve.at(per * per * slid.squaredNorm());
    return {link.area * link.time * link.depth * flow.potential, link.area * per * flow.viscosity,
            link.area * per * per * per * flow.slope};
  }
  [[nodiscard]] const Vector3* own_force(std::size_t i) const { return own_force_.empty() ? nullptr : &own_force_[i]; }

  [[nodiscard]] const ContactSpring& spring(std::size_t i) const { return rests_->springs()[i]; }

  // P e [m].
  [[nodiscard]] Vector3 way(std::size_t i, const VectorN<12>& u) const {
    return spring(i).along(weighted_sum(links_[i].weights, u) - links_[i].before);
  }
  // n·f - r + r̄, and what it meets.
  struct Squeeze {
    LongerRest longer;
    double thicker, stiffness; // [m], [N/m]
    Squeeze(const ContactShear& c, std::size_t i, const VectorN<12>& u)
        : longer(c.rests_->longer(i, u)), thicker(c.spring(i).normal.dot(weighted_sum(c.spring(i).weights, u)) -
                                                  c.links_[i].thickness - (longer.value - c.rests_->longer_before(i))),
          stiffness(c.links_[i].squeeze) {}
    [[nodiscard]] double work() const { return 0.5 * stiffness * thicker * thicker; }
  };
  void set_gradient(std::size_t i, const Vector3& dragged, const Squeeze& squeeze, VectorN<12>& gradient) const {
    const double force = squeeze.stiffness * squeeze.thicker;
    gradient = spread(links_[i].weights, dragged) + spread(spring(i).weights, force * spring(i).normal);
    squeeze.longer.add_to_gradient(force, gradient);
  }

  std::shared_ptr<const SpringRests> rests_;
  std::vector<Link> links_;
  LiquidFlows flows_;
  std::vector<Vector3> own_force_; // of what is not Newtonian, once Newton has gone a step [N]
};

} // namespace sheet
