// SPDX-License-Identifier: GPL-3.0-or-later
// What holds and walls do to the vertices [N], one a vertex; empty where it is not wanted. And what each solid does.
#pragma once
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

struct SolidForce {
  std::uint32_t solid; // its number in the scene
  Vector3 force;       // on the sheet [N]
};

struct HoldingForces {
  std::vector<Vector3> all;      // to hold them against everything
  std::vector<Vector3> external; // against that alone which acts from outside or on mass: weight, inertia, other layers
  // What solids do beyond `all`, which counts as that of the solid that a vertex touches: what lies in gaps feels the
  // pressure and a part of the drag of another one, what lies beside another one its push.
  std::vector<SolidForce> more;
};

} // namespace sheet
