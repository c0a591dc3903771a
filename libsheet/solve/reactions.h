// SPDX-License-Identifier: GPL-3.0-or-later
// What holds and walls do to the vertices: the force that must be added to all others, inertia included, so that the
// sum vanishes in the directions that they prescribe, and the drag of walls [N].
#pragma once
#include "libsheet/solve/holding_forces.h"
#include "libsheet/solve/stage_solve.h"

namespace sheet {

// Of a stage that took dt [s] in all, with its result u, from `start` to `end`: the forces that act in its implicit
// solve, of first order as forces at the end of the step. Changes stage.inertial.
[[nodiscard]] HoldingForces stage_reactions(LinearSystem& system, const Terms& terms, const Model& model,
                                            const State& start, const State& end, double dt, Stage& stage,
                                            const Unknowns& u);

// At the instant at which a step of dt [s] ends. A stage measures strain from its start, so its velocities are those
// that belong to the shape of a while ago; and beside a hold that is accelerated they are wrong in a layer as deep as
// viscosity reaches in a step, as the hold's way through the last stage is not that of its velocity at the end. So with
// the end's shape the balance of forces is solved once more, for velocities v,
//   m (v - v_end)/dt + m (v_end - v_start)/dt = f(x_end, v),
// which has the end's v where viscosity rules and v_end where inertia does. What is prescribed moves as is prescribed.
// Of second order; beside holds that are accelerated, what is left of the layer falls with the root of dt
// (docs/model.md). The terms and the system's constraints are afterwards those of that solve. Where it does not
// converge, v is that of its last iteration.
[[nodiscard]] HoldingForces end_reactions(LinearSystem& system, const Terms& terms, const Model& model,
                                          const State& start, const State& end, double dt,
                                          const NewtonOptions& options);

} // namespace sheet
