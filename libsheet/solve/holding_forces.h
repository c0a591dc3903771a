// SPDX-License-Identifier: GPL-3.0-or-later
// What holds and walls do to the vertices [N], one a vertex; empty where it is not wanted.
#pragma once
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

struct HoldingForces {
  std::vector<Vector3> all;      // to hold them against everything
  std::vector<Vector3> external; // against that alone which acts from outside or on mass: weight, inertia, other layers
  // What lies in gaps (channels.h): what the solid that it touches does to it beyond `all`, what the one that faces it
  // does, and that one's number, or no_index. All three empty where nothing does.
  std::vector<Vector3> of_gap, facing;
  std::vector<std::uint32_t> facing_solid;
};

} // namespace sheet
