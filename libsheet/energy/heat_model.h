// SPDX-License-Identifier: GPL-3.0-or-later
// What heats and cools a sheet, as plain numbers: in a scene with heat a step leads its temperatures, too.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/heat/profile.h"
#include "libsheet/heat/surroundings.h"

namespace sheet {

// A solid that lies on a face of the sheet at these vertices: that face sees nothing else there, and takes heat from it
// if it conducts.
struct WarmWall {
  std::vector<std::uint32_t> vertices;
  double conductance = 0;                                  // of the contact [W/(m² K)]
  std::function<double(double t)> temperature;             // [K]; empty: it takes no heat
  std::function<Vector3(double t, const Vector3&)> normal; // out of the solid
};

struct HeatModel {
  double capacity = 0;                                 // ρ c [J/(m³ K)]
  std::vector<double> capacities = {};                 // of each triangle, of several liquids; else empty
  double conductivity = 0;                             // [W/(m K)]
  heat::Profile profile = {};                          // across the thickness
  std::array<heat::Surroundings, 2> surroundings = {}; // of each face
  // Of each face, where they change over time or from place to place, at a triangle's centroid.
  std::array<std::function<heat::Surroundings(double t, const Vector3& x)>, 2> local_surroundings = {};
  bool viscous = false; // what viscosity dissipates becomes heat
  std::vector<WarmWall> walls = {};
};

// Heat that moved [J].
struct HeatMoved {
  double generated = 0, upper = 0, lower = 0, solids = 0; // by viscosity; out through each face; to solids
};

} // namespace sheet
