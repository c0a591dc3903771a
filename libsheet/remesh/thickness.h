// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness rule of every edit. Old triangles j with volume V_j, area A_j, thickness h_j = V_j / A_j; new ones i
// with area A_i and overlaps o_ij:
//   h*_i = Σ_j o_ij h_j / Σ_j o_ij   (a convex combination: no new extremes)
//   κ = Σ_j V_j / Σ_i h*_i A_i,   V_i = κ h*_i A_i,
// the largest takes the remainder of the rounding, so that the sum stays. κ differs from 1 where the edit changes the
// sheet's area. [Batty et al. 2012, section 3.6, has another rule for collapses, which loses volume at spikes.]
#pragma once
#include <span>

#include "libsheet/remesh/edit.h"

namespace sheet::remesh {

// Fills edit.volumes. `areas_removed`, `volumes_removed`: of edit.removed [m²], [m³]; `areas_added`: of edit.added, all
// positive. False, and the edit must not be made, if κ is outside [1/limit, limit].
[[nodiscard]] bool share_volume(Edit& edit, std::span<const double> areas_removed,
                                std::span<const double> volumes_removed, std::span<const double> areas_added,
                                double limit);

} // namespace sheet::remesh
