// SPDX-License-Identifier: GPL-3.0-or-later
// The eight parts of a block of voxels: their middles fit the lanes of a vector.
#pragma once
#include <cmath>

#include "libsheet/solid/vdb/lanes.h"

namespace sheet::solid {

inline constexpr int part_side = 4;                                            // voxels
inline const float part_half_diagonal = std::sqrt(3.0F) * (part_side - 1) / 2; // from the middle to the farthest voxel

// The middles of the parts of the block whose first voxel is (x, y, z), numbered 4 x + 2 y + z.
[[gnu::always_inline]] inline void find_middles(int x, int y, int z, LanePlace& middles) {
  constexpr float half = (part_side - 1) / 2.0F, next = part_side;
  middles = {static_cast<float>(x) + half + Lanes{0, 0, 0, 0, next, next, next, next},
             static_cast<float>(y) + half + Lanes{0, 0, next, next, 0, 0, next, next},
             static_cast<float>(z) + half + Lanes{0, next, 0, next, 0, next, 0, next}};
}

} // namespace sheet::solid
