// SPDX-License-Identifier: GPL-3.0-or-later
// What a flow curve has at one rate of strain.
#pragma once

namespace sheet {

struct FlowPoint {
  double potential = 0; // φ [Pa/s]
  double viscosity = 0; // η [Pa s]
  double slope = 0;     // d [Pa s³]
};

} // namespace sheet
