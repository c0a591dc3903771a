// SPDX-License-Identifier: GPL-3.0-or-later
// Surface tension of both faces: W = 2 γ (A - A0) [Batty et al. 2012, section 3.4], γ in N/m; A0, the area at the start
// of the step, only keeps round-off small. Where corners touch a wall along which liquid flows, the wetted face costs
// -cos θ in place of 1 [Young 1805]: a part (1 - cos θ) γ in place of 2 γ, for each corner a third. Faces within a pile
// of layers that flow as one liquid (scene/inner_faces.h) cost nothing.
// This is the term of flat triangles; where edges are arcs, see area_loads.h.
#pragma once
#include <utility>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/energy/walls.h"
#include "libsheet/geometry/area.h"

namespace sheet {

class SurfaceTension {
public:
  static constexpr Stencil stencil = Stencil::triangle;
  static constexpr Kind kind = Kind::elastic;
  // inner_faces: of each vertex (Model).
  explicit SurfaceTension(std::vector<double> inner_faces = {}) : inner_faces_(std::move(inner_faces)) {}
  [[nodiscard]] const char* name() const { return "surface tension"; }
  [[nodiscard]] std::size_t size() const { return start_area_.size(); }

  void begin(const Stage& stage) {
    const auto& triangles = stage.start->mesh->triangles;
    start_area_.resize(triangles.size());
    tension_.resize(triangles.size());
    const auto& x = stage.start->positions;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const double gamma = stage.surface_tension(t);
      tension_[t] = 2 * gamma;
      start_area_[t] = TriangleArea(x[triangles[t][0]], x[triangles[t][1]], x[triangles[t][2]]).area;
      for (const auto v : triangles[t]) {
        if (const WallSite* site = site_at(stage, v))
          tension_[t] += gamma * (site->wetting - 2) / 3;
        if (!inner_faces_.empty())
          tension_[t] -= gamma * inner_faces_[v] / 3;
      }
    }
  }

  [[nodiscard]] double tension(std::size_t i) const { return tension_[i]; } // dW/dA of triangle i [N/m]

  [[nodiscard]] double value(std::size_t i, const VectorN<9>& u) const {
    return tension_[i] * (TriangleArea(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6)).area - start_area_[i]);
  }

  double derivatives(std::size_t i, const VectorN<9>& u, VectorN<9>& gradient, MatrixN<9>& hessian,
                     bool definite) const {
    const TriangleArea a(u.segment<3>(0), u.segment<3>(3), u.segment<3>(6));
    gradient << a.gradient(0), a.gradient(1), a.gradient(2);
    gradient *= tension_[i];
    hessian = tension_[i] * a.hessian(!definite);
    return tension_[i] * (a.area - start_area_[i]);
  }

private:
  std::vector<double> inner_faces_;
  std::vector<double> start_area_, tension_; // [m²], [N/m]
};

} // namespace sheet
