// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a sheet spread that floats: the hydrostatic pressure of its own weight, over the thickness h = V/A_z, is
// the thrust ρ g h²/2 [N/m], whose potential for each triangle, in the part of its corners under the bath's surface, is
//   W = ρ g V²/(2 A_z),
// A_z its horizontal projection. Where the bath carries the sheet, gravity.h and bath.h together are the thrust
// -ρ² g h²/(2 ρ_b) of the depth to which it sinks, ρ_b the bath's density, so that the sum is that of a floating layer,
// ρ (1 - ρ/ρ_b) g h²/2 [Pegler and Worster 2012]. Pressure acts level, however a triangle leans: by its true area the
// thrust would buckle what is meshed by edges below 2.3 h. What stands on edge, or lies on its face, does not float: W
// is taken in part where the projection is below 3/4 of the area when a step begins, and not at all below 1/2. Corners
// that another layer bears count as above the surface, as what presses on a layer from both sides is in
// contact_squeeze.h, and so do those that the bath is around.
#pragma once
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/energy/element.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class BathThrust {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  // gravity [m/s²]; level, reach: as in BathSurface.
  BathThrust(const Vector3& gravity, double level, std::vector<BathReach> reach = {})
      : gravity_(gravity.norm()), surface_(gravity, level, std::move(reach)) {}
  [[nodiscard]] const char* name() const { return "bath thrust"; }
  [[nodiscard]] std::size_t size() const { return thrust_.size(); }

  void begin(const Stage& stage) {
    const auto& triangles = stage.start->mesh->triangles;
    const auto& x = stage.start->positions;
    thrust_.assign(triangles.size(), 0);
    start_.assign(triangles.size(), 1);
    side_.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const double volume = stage.start->volumes[t];
      for (const auto v : triangles[t])
        if (surface_.bears(v, x[v]))
          thrust_[t] += stage.liquid_of(t).liquid.density * gravity_ / 3 * volume * volume / 2;
      const TriangleArea area(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]);
      side_[t] = surface_.side(triangles[t]);
      start_[t] = side_[t] * area.area * area.normal.dot(surface_.up());
      const double level_part = area.area > 0 ? start_[t] / area.area : 0;
      thrust_[t] *= std::clamp((level_part - least_level) / (level_enough - least_level), 0.0, 1.0);
    }
  }

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    return thrust_[i] == 0 ? 0 : since_start(i, projection(i, u));
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    if (thrust_[i] == 0) {
      gradient.setZero();
      hessian.setZero();
      return 0;
    }
    const double area = projection(i, u);
    const double slope = thrust_[i] / (area * area); // -dW/dA_z
    for (int a = 0; a < 3; ++a)
      gradient.segment<3>(3 * a) =
          0.5 * side_[i] * surface_.up().cross(u.segment<3>(3 * ((a + 2) % 3)) - u.segment<3>(3 * ((a + 1) % 3)));
    hessian = 2 * slope / area * gradient * gradient.transpose();
    if (!definite) {
      const Matrix3 turn = 0.5 * side_[i] * slope * skew(surface_.up());
      for (int a = 0; a < 3; ++a) {
        hessian.block<3, 3>(3 * a, 3 * ((a + 2) % 3)) -= turn;
        hessian.block<3, 3>(3 * a, 3 * ((a + 1) % 3)) += turn;
      }
    }
    gradient *= -slope;
    return since_start(i, area);
  }

private:
  static constexpr double least_level = 0.5, level_enough = 0.75; // projection over area

  [[nodiscard]] double projection(std::size_t i, const VectorN<9>& u) const {
    const Vector3 a = u.segment<3>(0), b = u.segment<3>(3), c = u.segment<3>(6);
    return 0.5 * side_[i] * surface_.up().dot((b - a).cross(c - a));
  }
  // W less that at the start, which only keeps round-off small.
  [[nodiscard]] double since_start(std::size_t i, double area) const {
    return area > 0 ? thrust_[i] * (start_[i] - area) / (area * start_[i]) : std::numeric_limits<double>::infinity();
  }

  double gravity_; // [m/s²]
  BathSurface surface_;
  std::vector<double> thrust_, start_, side_; // W A_z [J m²], A_z at the start [m²], its sign as in bath.h
};

} // namespace sheet
