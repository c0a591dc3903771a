// SPDX-License-Identifier: GPL-3.0-or-later
// What a layer's own weight does to it along its wall: the hydrostatic pressure ρ g_n (h - z), over the thickness, is
// the thrust ρ g_n h²/2 [N/m] by which thick parts flow to thin ones [Huppert 1982]. Its potential is
//   W = ρ g_n V²/(2 A),
// for each triangle in the part of its corners that touch; g_n is gravity's part towards the wall, and never below 0:
// layers that hang are unstable, at wavelengths that no such equation bounds.
// The place of a layer across its wall is given, so Gravity (gravity.h) has no part in this.
// On a bath: bath_thrust.h.
#pragma once
#include <algorithm>
#include <array>

#include "libsheet/energy/element.h"
#include "libsheet/energy/falls_with_area.h"
#include "libsheet/energy/walls.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class WallWeight {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  explicit WallWeight(const Vector3& gravity) : gravity_(gravity) {} // [m/s²]
  [[nodiscard]] const char* name() const { return "weight on walls"; }
  [[nodiscard]] std::size_t size() const { return thrust_.size(); }

  void begin(const Stage& stage) {
    const auto& triangles = stage.start->mesh->triangles;
    const auto& x = stage.start->positions;
    thrust_.assign(triangles.size(), 0);
    start_area_.assign(triangles.size(), 1);
    for (std::size_t t = 0; t < triangles.size() && !stage.sites.empty(); ++t) {
      const Vector3 weight = stage.liquid_of(t).liquid.density * gravity_; // of a cubic metre [N/m³]
      std::array<Bearing, 3> bearings;
      for (std::size_t c = 0; c < 3; ++c)
        if (const WallSite* site = site_at(stage, triangles[t][c]))
          bearings[c] = {lying(stage, t, *site), std::max(0.0, -weight.dot(site->normal)), true};
      const double towards = borne(bearings);
      const double volume = stage.start->volumes[t];
      thrust_[t] = towards * volume * volume / 2;
      start_area_[t] = TriangleArea(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]).area;
    }
  }

  [[nodiscard]] double thrust(std::size_t i) const { return thrust_[i]; } // W A of triangle i [J m²]

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    return thrust_[i] == 0 ? 0 : since_start(i, TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    if (thrust_[i] == 0) {
      gradient.setZero();
      hessian.setZero();
      return 0;
    }
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    const double slope = thrust_[i] / (a.area * a.area);
    falls_with_area(a, slope, 2 * slope / a.area, gradient, hessian, definite);
    return since_start(i, a.area);
  }

private:
  // What the wall of a corner bears.
  struct Bearing {
    double lying = 0, weight = 0; // in what part the triangle lies on it; of a cubic metre towards it [N/m³]
    bool touches = false;
  };

  // The weight of a cubic metre towards the walls [N/m³]: a corner that touches a wall on which the triangle stands,
  // while another one's lies below it, as in the corner of a dish, is borne by that.
  [[nodiscard]] static double borne(const std::array<Bearing, 3>& bearings) {
    const Bearing& best = *std::ranges::max_element(bearings, {}, &Bearing::lying);
    double sum = 0;
    for (const Bearing& b : bearings)
      if (b.touches)
        sum += b.weight / 3 * b.lying + best.weight / 3 * (best.lying - b.lying);
    return sum;
  }

  // W less that at the start, which only keeps round-off small.
  [[nodiscard]] double since_start(std::size_t i, double area) const {
    return thrust_[i] * (start_area_[i] - area) / (area * start_area_[i]);
  }

  Vector3 gravity_;                         // [m/s²]
  std::vector<double> thrust_, start_area_; // W A [J m²], [m²]
};

} // namespace sheet
