// SPDX-License-Identifier: GPL-3.0-or-later
// The mean of the normals of the triangles at each edge: what directors are measured from.
#pragma once
#include <span>
#include <vector>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/director.h"

namespace sheet {

// For each edge its direction and the mean of the normals at it, or, where these cancel (a sheet folded flat), the
// direction into the triangles, which is the limit from a fold whose positive sides face each other.
[[nodiscard]] std::vector<EdgeFrame> mean_normal_frames(const Connectivity& mesh, std::span<const Vector3> positions);

// The same, turned about the edges by these angles [rad], one an edge; none: by nothing.
[[nodiscard]] std::vector<EdgeFrame> director_frames(const Connectivity& mesh, std::span<const Vector3> positions,
                                                     std::span<const double> angles);

} // namespace sheet
