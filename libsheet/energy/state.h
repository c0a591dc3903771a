// SPDX-License-Identifier: GPL-3.0-or-later
// What a time step needs to know of a sheet: positions [m], velocities [m/s], the volume [m³] of each triangle, and,
// where it bends by directors, the angle [rad] of each edge's from the mean of the normals there.
// Thickness is volume / area, everywhere. Connectivity is shared and constant during a step.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "libsheet/energy/gas.h"
#include "libsheet/energy/heat_model.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/overshoot.h"

namespace sheet {

struct State {
  std::shared_ptr<const Connectivity> mesh;
  std::vector<Vector3> positions;
  std::vector<Vector3> velocities;
  std::vector<double> volumes;
  std::vector<std::uint32_t> liquids;                            // of each triangle its liquid's number; none: all 0
  std::vector<double> temperatures;                              // of each triangle [K]; none: the liquid has none
  std::vector<double> temperature_rates;                         // how fast they changed last [K/s]; none: all are 0
  std::vector<double> temperature_modes, temperature_mode_rates; // likewise, across the thickness (heat/profile.h)
  HeatMoved heat_moved;                                          // since the step of the stream began [J]
  std::vector<double> director_angles;                           // none: all are 0
  std::vector<Overshoot> to_make_up;                             // of each vertex; none: all are 0
  std::vector<Vector3> overshoot; // positions less where a solid holds them [m], within a step; none: all are 0
  std::vector<Gas> gas;           // that it encloses, one an enclosure; without one: as its law starts
  double time = 0;                // [s]
};

} // namespace sheet
