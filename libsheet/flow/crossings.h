// SPDX-License-Identifier: GPL-3.0-or-later
// Whether what a stage has moved by hand meets the rest of the sheet.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet::flow {

// Whether a triangle with a corner that is flagged in `moved` (one a vertex) meets another one; neighbours do where
// they overlap. In time n for n triangles and few that moved.
[[nodiscard]] bool moved_triangles_cross(std::span<const Vector3> x, std::span<const Corners> triangles,
                                         const std::vector<bool>& moved);

} // namespace sheet::flow
