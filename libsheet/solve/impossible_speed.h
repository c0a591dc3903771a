// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a step has made energy from nothing: no vertex can have more kinetic energy at its end than the whole sheet
// had at its start and all that can have worked on it since has given. A step's error says nothing of that, as steps
// shrink until even what flies moves by a part of an edge.
#pragma once
#include <optional>

#include "libsheet/energy/model.h"

namespace sheet {

struct ImpossibleSpeed {
  std::size_t vertex = 0;
  double energy = 0, work = 0; // that it has; that it can have at most [J]
};

// Of the vertex that exceeds its bound most, if any does. Counted are the kinetic energy at the start, gravity's work
// on each vertex, the weight of layers that spread, the area that tension has drawn in, pressure, contact springs, and
// half the sheet's mass times the square of the fastest prescribed speed, or of what round-off makes. Without inertia,
// and where pressure depends on the volume in ways that bound nothing (laws "inverse_square", "draining"), there is
// none.
[[nodiscard]] std::optional<ImpossibleSpeed> impossible_speed(const Model& model, const State& start, const State& end);

} // namespace sheet
