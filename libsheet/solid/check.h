// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of solids told from what is none.
#pragma once
#include <string>

#include "libsheet/solid/mesh.h"

namespace sheet::solid {

// Throws Error (bad_input), with the name, the place and a remedy, unless the surface is finite, has triangles with
// area, is closed (each edge between two triangles that run along it in opposite directions), encloses a volume, does
// not intersect itself (exactly) and faces outward. The check of intersections is the only one that
// takes more than a pass over the triangles; it is left out where `simple` says that it was done before.
void check_surface(const SolidSurface& surface, const std::string& name, bool simple = false);

} // namespace sheet::solid
