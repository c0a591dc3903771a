// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to the surface of a body after it was found: its volume set, parts of it taken out.
#pragma once
#include <functional>

#include "libsheet/solid/mesh.h"

namespace sheet::solid {

// Moves all points along their normals by the same way, at most `farthest`, such that the surface holds the volume.
// Returns the way, outward.
double inflate_to(double volume, double farthest, SolidSurface& surface);

// Takes out the parts, connected by triangles, at most of whose points `is_out` holds.
void drop_parts(const std::function<bool(const Vector3&)>& is_out, SolidSurface& surface);

} // namespace sheet::solid
