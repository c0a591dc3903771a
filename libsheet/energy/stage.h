// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit solve within a time step: everything that an energy term may refer to. A backward-Euler step is one
// stage; SDIRK2 has two, the second of which refers to quantities extrapolated from the first:
//   reference = start + ratio (previous - start), for positions and for the metric and curvature of each triangle.
// The unknowns are one vector: three coordinates [m] a vertex, then, if the sheet bends by directors, one angle [rad]
// an edge.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/state.h"
#include "libsheet/geometry/director.h"
#include "libsheet/geometry/metric.h"

namespace sheet {

using Unknowns = Eigen::VectorXd;

struct Stage {
  const State* start = nullptr;
  double duration = 0;                // of the implicit solve: dt, or gamma dt [s]
  double end_time = 0;                // at which time-dependent forces act [s]
  double ratio = 0;                   // 0 in a first stage, (1 - gamma)/gamma in a second
  Unknowns begin;                     // the unknowns at the start of the step
  const Unknowns* previous = nullptr; // the first stage's result, null in a first stage
  std::vector<EdgeFrame> frames;      // of the directors, at the start of the step; empty without directors
  std::vector<RaisedMetric> raised;   // for each triangle: the metric that raises indices and weighs by area
  std::vector<Vector3> inertial;      // where the vertices would go without force [m]
  std::vector<Vector3> predicted;     // the extrapolated end of the stage, for what is lagged [m]

  [[nodiscard]] std::size_t vertices() const { return start->positions.size(); }
  [[nodiscard]] Vector3 position(const Unknowns& u, std::uint32_t v) const { return u.segment<3>(3 * v); }
};

} // namespace sheet
