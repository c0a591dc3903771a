// SPDX-License-Identifier: GPL-3.0-or-later
// What a time step needs to know of a sheet: positions [m], velocities [m/s], the volume [m³] of each triangle.
// Thickness is volume / area, everywhere. Connectivity is shared and constant during a step.
#pragma once
#include <memory>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

struct State {
  std::shared_ptr<const Connectivity> mesh;
  std::vector<Vector3> positions;
  std::vector<Vector3> velocities;
  std::vector<double> volumes;
  double time = 0; // [s]
};

} // namespace sheet
