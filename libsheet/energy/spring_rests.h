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
#include <span>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/energy/stage.h"
#include "libsheet/geometry/area.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

// Σ w_i u_i of the unknowns of an element of four vertices.
[[nodiscard]] inline Vector3 weighted_sum(const std::array<double, 4>& w, const VectorN<12>& u) {
  return w[0] * u.segment<3>(0) + w[1] * u.segment<3>(3) + w[2] * u.segment<3>(6) + w[3] * u.segment<3>(9);
}

// At vertices, for the end of a stage: by the velocities of the step's start, in a second stage by the way of the first
// [m].
[[nodiscard]] std::vector<double> predicted_thickness(const Stage& stage);

class SpringRests {
public:
  // springs: outlive it; flow: whether their rest distances go with thickness; else nothing below is ever but 0.
  SpringRests(std::span<const ContactSpring> springs, bool flow) : springs_(springs), flow_(flow) {}
  void begin(const Stage& stage);

  // d - d0 [m].
  [[nodiscard]] double longer(std::size_t i, const VectorN<12>& u) const {
    if (!flow_)
      return 0;
    const Rest& r = rests_[i];
    return r.predicted + (r.volume > 0 ? r.volume / foot(u).area : 0);
  }
  // Likewise where strain is measured from (reference_position).
  [[nodiscard]] double longer_before(std::size_t i) const { return flow_ ? before_[i] : 0; }
  // Likewise of all springs at the start of the step, in a second stage at the end of the first, as it was there.
  [[nodiscard]] std::vector<double> longer_at_last(const Stage& stage) const;

  // Adds to the derivatives of k g²/2, g = n·Σ w_i x_i - d0 - from, what d0 leaves out: those of g = n·Σ w_i x_i - d -
  // from, whose value is `gap`.
  void add_derivatives(std::size_t i, const VectorN<12>& u, double k, double gap, VectorN<12>& gradient,
                       MatrixN<12>& hessian, bool definite) const;

private:
  struct Rest {
    double predicted = 0; // d0 h/(h0 + h0') - d0 [m]
    double volume = 0;    // d0 V/(h0 + h0') [m³]
  };
  [[nodiscard]] static TriangleArea foot(const VectorN<12>& u) {
    return {u.segment<3>(3), u.segment<3>(6), u.segment<3>(9)};
  }
  // Of the thickness at vertices at the start of the step and at the end of the stage.
  [[nodiscard]] std::vector<Rest> rests_with(const Stage& stage, std::span<const double> start,
                                             std::span<const double> end) const;

  std::span<const ContactSpring> springs_;
  bool flow_;
  std::vector<Rest> rests_;
  std::vector<double> before_;
};

} // namespace sheet
