// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of a body of several layers, smooth across the folds and rims of its surface.
#pragma once
#include <vector>

#include "libsheet/render/near_layers.h"

namespace sheet::render {

// The normals of the surface, each turned so far as layers are close there (`closeness` of near_layers) to the mean of
// its own and of what is bare around it, not `covered` by others, up to `radius` [m] away, by area and nearness (a
// kernel that ends there smoothly), as far as it faces the same way.
[[nodiscard]] std::vector<Vec> melted_normals(const Surface& surface, const std::vector<float>& closeness,
                                              const std::vector<float>& covered, double radius);

} // namespace sheet::render
