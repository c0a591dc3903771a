// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that others press on flow out from under them, and what lies on others spreads by its own weight. Between the
// pressures P below and p above, a layer of thickness h has the thrust (P + p) h/2 [N/m]; on a wall, which bears its
// own weight, P = p + ρ g_n h, and wall_weight.h has the rest [Huppert 1982, for the pressure of a layer at rest].
// Elsewhere P - p is what its weight needs, g_n the part of gravity across it, as far as other layers bear it. For each
// triangle
//   W = -q V ln(A/A0) + ρ g_b V²/(2 A),
// q [Pa] the mean over its corners, p on walls and on a bath on which a sheet spreads (bath_thrust.h), elsewhere the
// less of P and p, and g_b there what springs bear of its weight, at most g_n [m/s²]. Both are from the forces of the
// contact springs at the start of the step, in a second stage at the end of the first, by the vertices' areas and
// masses; q as felt in the mean over the layer's depth. (By P itself what lies on a layer would have a ragged rim: few
// springs bear it, each where it happens to be.) Springs that pull do not count: layers that hang from each other would
// be unstable at wavelengths that no such equation bounds.
#pragma once
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/falls_with_area.h"
#include "libsheet/geometry/area.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

class ContactSqueeze {
public:
  // What springs press with on a vertex.
  struct Press {
    std::array<double, 2> on_side{}; // of the sheet, that its normal leaves and the other one [N]
    Vector3 force = Vector3::Zero(); // [N]
  };

  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  // springs: outlive the term; gravity [m/s²]; bath: on which the sheet spreads, if it does.
  ContactSqueeze(std::span<const ContactSpring> springs, const Vector3& gravity, std::optional<BathSurface> bath = {})
      : springs_(springs), gravity_(gravity), bath_(std::move(bath)) {}
  [[nodiscard]] const char* name() const { return "squeezed layers"; }
  [[nodiscard]] std::size_t size() const { return work_.size(); }
  void begin(const Stage& stage);
  [[nodiscard]] double work(std::size_t i) const { return work_[i]; }     // q V of triangle i [J]
  [[nodiscard]] double thrust(std::size_t i) const { return thrust_[i]; } // ρ g_b V²/2 [J m²]

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    return idle(i) ? 0 : since_start(i, TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    if (idle(i)) {
      gradient.setZero();
      hessian.setZero();
      return 0;
    }
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    const double presses = work_[i] / a.area, weighs = thrust_[i] / (a.area * a.area);
    falls_with_area(a, presses + weighs, (presses + 2 * weighs) / a.area, gradient, hessian, definite);
    return since_start(i, a.area);
  }

private:
  struct Borne {
    Vector3 force = Vector3::Zero(); // [N]
    double mass = 0;                 // [kg]
    friend Borne operator+(const Borne& a, const Borne& b) { return {a.force + b.force, a.mass + b.mass}; }
  };
  [[nodiscard]] std::vector<Borne> borne_around(const Stage& stage, std::span<const Press> press) const;
  [[nodiscard]] double own_thrust(const Stage& stage, std::size_t t, const Vector3& normal,
                                  std::span<const Borne> borne) const;
  // Whether the springs press on a vertex from above, as a wall or a bath bears it.
  [[nodiscard]] bool from_above_only(const Stage& stage, std::uint32_t v) const;
  [[nodiscard]] bool idle(std::size_t i) const { return work_[i] == 0 && thrust_[i] == 0; }
  [[nodiscard]] double since_start(std::size_t i, double area) const {
    return thrust_[i] * (start_area_[i] - area) / (area * start_area_[i]) - work_[i] * std::log(area / start_area_[i]);
  }

  std::span<const ContactSpring> springs_;
  Vector3 gravity_;
  std::optional<BathSurface> bath_;
  std::vector<double> work_, thrust_, start_area_; // q V [J], ρ g_b V²/2 [J m²], [m²]
};

} // namespace sheet
