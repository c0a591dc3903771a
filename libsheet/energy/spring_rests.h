// SPDX-License-Identifier: GPL-3.0-or-later
// The rest distances of contact springs. Between layers that flow the rest distance d goes with their thickness, of h
// at the vertex and h' = V/A of the triangle on which it stands, as it was d0 with h0 and h0' [m]:
//   d(x) = d0 (h + V/A(x))/(h0 + h0').
// h' is of the triangle's area as it moves: a spring that presses with F draws its triangle out by F d0/(h0 + h0') h'/A
// [N/m], a part of the thrust of a layer between two pressures, and a stack sinks as it thins, within the step and with
// inertia. h is foreseen for the stage's end; contact_squeeze.h has the rest of the thrust. (Were both foreseen, a
// stack with inertia would swing: thickness follows pressure, and pressure how the stack sinks.) Of edges both are
// foreseen. Of a crumb (of_layer) h' stays; where layers do not flow d does, and where d0 is negative
// (rest_of_layers). Ours; not in [Batty et al. 2012].
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/energy/stage.h"
#include "libsheet/geometry/area.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

// Σ w_i u_i of the unknowns of an element of four vertices.
[[nodiscard]] inline Vector3 weighted_sum(const std::array<double, 4>& w, const VectorN<12>& u) {
  return w[0] * u.segment<3>(0) + w[1] * u.segment<3>(3) + w[2] * u.segment<3>(6) + w[3] * u.segment<3>(9);
}

// The gradient of n·Σ w_i u_i by these unknowns.
[[nodiscard]] inline VectorN<12> spread(const std::array<double, 4>& w, const Vector3& n) {
  VectorN<12> u;
  u << w[0] * n, w[1] * n, w[2] * n, w[3] * n;
  return u;
}

// At vertices, for the end of a stage: by the velocities of the step's start, in a second stage by the way of the first
// [m].
[[nodiscard]] std::vector<double> predicted_thickness(const Stage& stage);

// d - d0 of a spring at some unknowns, and its derivatives.
struct LongerRest {
  double value = 0;                 // [m]
  double volume = 0;                // d0 V/(h0 + h0') [m³]
  std::optional<TriangleArea> foot; // of what goes with the area of its triangle

  // Of g = n·Σ w_i x_i - d: what -d adds to its gradient.
  void add_to_gradient(double times, VectorN<12>& gradient) const;
  // To the Hessian of k g²/2, whose force is k g, given the gradient of n·Σ w_i x_i.
  void add_to_hessian(double k, double force, const VectorN<12>& along, MatrixN<12>& hessian, bool definite) const;
};

// Of all springs of a sheet, which its contact terms share: Contact begins them.
class SpringRests {
public:
  // springs: outlive it; flow: whether their rest distances go with thickness; else nothing below is ever but 0.
  SpringRests(std::span<const ContactSpring> springs, bool flow, const Connectivity& mesh);
  void begin(const Stage& stage);

  [[nodiscard]] std::span<const ContactSpring> springs() const { return springs_; }
  [[nodiscard]] LongerRest longer(std::size_t i, const VectorN<12>& u) const {
    if (!flow_)
      return {};
    const Rest& r = rests_[i];
    if (r.volume == 0)
      return {.value = r.predicted, .volume = 0, .foot = {}};
    const TriangleArea foot(u.segment<3>(3), u.segment<3>(6), u.segment<3>(9));
    return {r.predicted + r.volume / foot.area, r.volume, foot};
  }
  // d - d0 where strain is measured from (reference_position) [m].
  [[nodiscard]] double longer_before(std::size_t i) const { return flow_ ? before_[i] : 0; }
  // Likewise of all springs at the start of the step, in a second stage at the end of the first, as it was there.
  [[nodiscard]] std::vector<double> longer_at_last(const Stage& stage) const;

private:
  struct Rest {
    double predicted = 0; // d0 h/(h0 + h0') - d0 [m]
    double volume = 0;    // LongerRest::volume
  };
  // The triangle on which the vertex of a spring stands, without volume of one of edges.
  struct Foot {
    Corners corners;
    double volume = 0, area = 0; // [m³], at the start of the step [m²]
  };
  [[nodiscard]] Foot foot_of(std::size_t i, const Stage& stage) const;
  // Of the thickness at vertices at the start of the step and at the end of the stage.
  [[nodiscard]] std::vector<Rest> rests_with(const Stage& stage, std::span<const double> start,
                                             std::span<const double> end) const;

  std::span<const ContactSpring> springs_;
  bool flow_;
  std::vector<std::uint32_t> triangles_; // on which they stand; no_index: of edges
  std::vector<Rest> rests_;
  std::vector<double> before_;
};

} // namespace sheet
