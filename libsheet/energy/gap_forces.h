// SPDX-License-Identifier: GPL-3.0-or-later
// What two walls do to the liquid that fills the gap between them (channels.h) [N], one a vertex.
#pragma once
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet {

struct GapForces {
  std::vector<Vector3> own;    // the wall that a vertex touches, beyond the drag of both (Term::add_wall_forces)
  std::vector<Vector3> facing; // the wall that faces it
};

} // namespace sheet
