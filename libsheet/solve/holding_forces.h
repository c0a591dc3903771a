// SPDX-License-Identifier: GPL-3.0-or-later
// What holds and walls do to the vertices [N], one a vertex; empty where it is not wanted.
#pragma once
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

struct HoldingForces {
  std::vector<Vector3> all;      // to hold them against everything
  std::vector<Vector3> external; // against that alone which acts from outside or on mass: weight, inertia, other layers
};

} // namespace sheet
