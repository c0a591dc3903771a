// SPDX-License-Identifier: GPL-3.0-or-later
// The thickness rule of every edit. Old triangles j with volume V_j, area A_j, thickness h_j = V_j / A_j; new ones i
// with area A_i and overlaps o_ij, whose middles are at x_ij:
//   h*_i = Σ_j o_ij (h_j + s_j·(x_ij - x_j)) / Σ_j o_ij   (no new extremes)
//   κ = Σ_j V_j / Σ_i h*_i A_i,   V_i = κ h*_i A_i,
// the largest takes the remainder of the rounding, so that the sum stays. κ differs from 1 where the edit changes the
// sheet's area. The slope s_j is the one of least squares through the triangles beside j, scaled down until no
// s_j·(x_ij - x_j) leads out of the range of j's thickness and theirs (after [Barth, Jespersen 1989]): without it a
// step of thickness would widen with the square root of the number of edits. [Batty et al. 2012, section 3.6, has
// another rule for collapses, which loses volume at spikes.]
#pragma once
#include <span>

#include "libsheet/geometry/overlap.h"
#include "libsheet/remesh/edit.h"

namespace sheet::remesh {

// Of the thickness, or of another quantity that triangles have.
struct ValueAt {
  Eigen::Vector2d middle; // of a triangle, in the plane of an edit [m]
  double value;
};

struct ValueSlope {
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double least = 0, most = 0; // how far the triangles beside are below and above
};
// s_j above, not yet scaled. `beside`: the triangles that share an edge with it, up to three.
[[nodiscard]] ValueSlope slope_of(const ValueAt& triangle, std::span<const ValueAt> beside);
// s_j·(x_ij - x_j), of old triangle j in all new ones. `ways`: x_ij - x_j, zero where they do not overlap.
void find_rises(const ValueSlope& slope, std::span<const Eigen::Vector2d> ways, std::span<double> rises);

// Fills edit.volumes. `areas_removed`, `volumes_removed`: of edit.removed [m²], [m³]; `areas_added`: of edit.added, all
// positive. False, and the edit must not be made, if κ is outside [1/limit, limit].
[[nodiscard]] bool share_volume(Edit& edit, std::span<const double> areas_removed,
                                std::span<const double> volumes_removed, std::span<const double> areas_added,
                                double limit);

// The rule mean (formats/sheet.md, section 4), for one number a triangle, with pieces v_ij = o_ij (h_j + s_j·(...)):
//   T_i = c + Σ_j v_ij (T_j + t_j·(x_ij - x_j)) / Σ_j v_ij,   Σ_i V_i T_i = Σ_j V_j T_j by c,
// t_j limited slopes as above. `rises`: t_j·(x_ij - x_j), as edit.rise.
[[nodiscard]] std::vector<double> share_mean(const Edit& edit, std::span<const double> areas_removed,
                                             std::span<const double> volumes_removed, std::span<const double> values,
                                             std::span<const double> rises);

} // namespace sheet::remesh
