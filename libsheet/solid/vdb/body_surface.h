// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to the surface of a body after it was found: its voids taken out, its volume set.
#pragma once
#include <cstddef>

#include "libsheet/solid/mesh.h"

namespace sheet::solid {

struct Voids {
  std::size_t count = 0;
  double air = 0; // volume of those that are wide, without the liquid within
};

// Takes out the parts of a closed surface that face inward, and what lies within them. A void is wide if twice its
// volume is above `wide` times the area of its surface: of a gap between layers that is its width.
Voids drop_voids(double wide, SolidSurface& surface);

// Moves all points along their normals by the same way, at most `farthest`, such that the surface holds the volume.
// Returns the way, outward.
double inflate_to(double volume, double farthest, SolidSurface& surface);

} // namespace sheet::solid
