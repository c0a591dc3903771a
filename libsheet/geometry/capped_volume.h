// SPDX-License-Identifier: GPL-3.0-or-later
// The volume that a sheet encloses.
#pragma once
#include <span>

#include "libsheet/geometry/connectivity.h"

namespace sheet {

// [m³], positive if the triangles' normals point out of it. Each rim is closed by the cone from the mean of its
// vertices, so that a closed sheet has its own volume, and a flat sheet with a round rim none. `part`: of each
// triangle, whether it counts, alike for all that are joined; empty: all do.
[[nodiscard]] double capped_volume(const Connectivity& mesh, std::span<const Vector3> positions,
                                   std::span<const char> part = {});

} // namespace sheet
