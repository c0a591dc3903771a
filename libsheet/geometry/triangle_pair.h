// SPDX-License-Identifier: GPL-3.0-or-later
// Whether two triangles of a mesh intersect: decided exactly on the vertices' coordinates as they are (CGAL's exact
// predicates), at any scale. Triangles are closed sets, so touching counts; neighbours may meet in what they share,
// their common vertex or edge, and in nothing else.
#pragma once
#include <span>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// Precondition: neither triangle's corners lie on a line. Two triangles at the same three vertices do not intersect
// here: they are duplicates.
[[nodiscard]] bool triangles_intersect(std::span<const Vector3> positions, const Corners& a, const Corners& b);

// True if the corners lie on a line, exactly.
[[nodiscard]] bool corners_collinear(std::span<const Vector3> positions, const Corners& triangle);

} // namespace sheet
