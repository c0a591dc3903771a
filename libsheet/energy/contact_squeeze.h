// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that others press on flow out from under them. Between the pressures P below and p above, a layer of thickness
// h has the thrust (P + p) h/2 [N/m]; on a wall, which bears its own weight, P = p + ρ g_n h, and wall_weight.h has the
// rest [Huppert 1982, for the pressure of a layer at rest]. For each triangle
//   W = -q V ln(A/A0),
// q the mean over its corners [Pa]: from the forces of the contact springs at the start of the step, in a second stage
// at the end of the first, those that pull taken off, by the areas of a vertex and its neighbours, as felt in the mean
// over the layer's depth; none where they pull in the mean. What stands on its triangles draws them out by itself
// (spring_rests.h), half of the thrust; the other half is half of what the springs of its vertices press with. On walls
// and on a bath on which a sheet spreads (bath_thrust.h) half of what all of them press with comes to it, as nothing
// below is a spring. A crumb has none.
#pragma once
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/element.h"
#include "libsheet/energy/falls_with_area.h"
#include "libsheet/energy/spring_rests.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class ContactSqueeze {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  // rests: those of layers that flow; bath: on which the sheet spreads, if it does.
  explicit ContactSqueeze(std::shared_ptr<const SpringRests> rests, std::optional<BathSurface> bath = {})
      : rests_(std::move(rests)), bath_(std::move(bath)) {}
  [[nodiscard]] const char* name() const { return "squeezed layers"; }
  [[nodiscard]] std::size_t size() const { return work_.size(); }
  void begin(const Stage& stage);
  [[nodiscard]] double work(std::size_t i) const { return work_[i]; } // q V of triangle i [J]

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    return work_[i] == 0 ? 0 : since_start(i, TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    if (work_[i] == 0) {
      gradient.setZero();
      hessian.setZero();
      return 0;
    }
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    const double slope = work_[i] / a.area;
    falls_with_area(a, slope, slope / a.area, gradient, hessian, definite);
    return since_start(i, a.area);
  }

private:
  // Whether the springs press on a vertex from above, as a wall or a bath bears it.
  [[nodiscard]] bool from_above_only(const Stage& stage, std::uint32_t v) const;
  [[nodiscard]] double since_start(std::size_t i, double area) const {
    return -work_[i] * std::log(area / start_area_[i]);
  }

  std::shared_ptr<const SpringRests> rests_;
  std::optional<BathSurface> bath_;
  std::vector<double> work_, start_area_; // q V [J], [m²]
};

} // namespace sheet
