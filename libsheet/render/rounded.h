// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a sheet with finer triangles, round where the sheet's are flat.
#pragma once
#include <vector>

#include "libsheet/render/surface.h"

namespace sheet::render {

// Each triangle in four. The middle of an edge lies on the cubic that leaves its ends along their tangent planes, and
// its normal is that of such a patch [Vlachos, Peters, Boyd, Mitchell 2001, Curved PN triangles], as far as `roundness`
// says at the sheet's vertices (0 to 1; 0: the same surface), but no farther than half the thickness. `roundness` gets
// entries for the new vertices.
[[nodiscard]] Surface rounded(const Surface& surface, std::vector<float>& roundness);

} // namespace sheet::render
