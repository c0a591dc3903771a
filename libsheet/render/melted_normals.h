// SPDX-License-Identifier: GPL-3.0-or-later
// Normals of a body of several layers, smooth across the folds and rims of its surface.
#pragma once
#include <vector>

#include "libsheet/render/surface.h"

namespace sheet::render {

// The normals of the surface, each of those chosen being the mean of its own and of what is bare around it, up to
// `radius` [m] away, by area and nearness (a kernel that ends there smoothly), as far as it faces the same way.
[[nodiscard]] std::vector<Vec> melted_normals(const Surface& surface, const std::vector<char>& chosen,
                                              const std::vector<char>& bare, double radius);

} // namespace sheet::render
