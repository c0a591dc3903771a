// SPDX-License-Identifier: GPL-3.0-or-later
// Levelling of layers on walls, below what the mesh can show. There are twice as many triangles as vertices, so most
// patterns of thickness cannot move the vertices, and would stay for ever; and a front at which thick liquid overruns
// thin is steeper than an edge. A layer's weight and tension level it by a flux of volume
//   q = -(D_g + D_γ) ∇h,   D_g = g_n h² (h + 3 b)/(3 ν),   D_γ = γ k² h² (h + 3 b)/(3 μ)
// [Oron, Davis and Bankoff 1997, section II.B], of a liquid that is not Newtonian q = h u(τ_w) (wall_flow.h), τ_w the
// stress at the wall of the same forces, so that nothing levels below a yield stress; k = 1/l for patterns of the size
// of an edge l. What vertices see, the means H around them, flows with them (wall_weight.h); volume goes between
// triangles by the rest, h - H, which falls with the edges squared, so orders stay of the weight's part. Of the
// tension's it is half of what a wave of any length flows: where its slopes drive that themselves (slope_tension.h)
// only the rest of the rest goes, which falls with the fourth power.
#pragma once
#include "libsheet/energy/holds.h"
#include "libsheet/energy/stage.h"

namespace sheet {

// Levels `end`, the end of a step of dt [s] whose last stage is given: its volumes, and the velocities with them, so
// that volume and momentum stay. sloped: tension sees slopes. No new extremes. Where the rim is not held at all, what
// is there stays as it is. False where there is no wall.
bool level_layers(const Stage& stage, const Vector3& gravity, const std::vector<Hold>& holds, bool sloped, double dt,
                  State& end);

} // namespace sheet
