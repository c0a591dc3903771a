// SPDX-License-Identifier: GPL-3.0-or-later
// Planes and points as sheet-info's --cut and --at say them.
#pragma once
#include <string_view>

#include "libsheet/geometry/types.h"

namespace sheet {

// The points x with normal·x = offset.
struct CutPlane {
  Vector3 normal = Vector3::UnitX(); // of any length but zero
  double offset = 0;                 // [m] times the normal's length
};

// "x=0", "y = 2 mm", "0.3x - 2*y + z = 1 mm": coordinates with plain factors, and a length. Throws Error (usage).
[[nodiscard]] CutPlane parse_cut_plane(std::string_view text);

// "0,2mm,-0.1" [m]. Throws Error (usage).
[[nodiscard]] Vector3 parse_point(std::string_view text);

} // namespace sheet
