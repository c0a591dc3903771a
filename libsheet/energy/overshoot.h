// SPDX-License-Identifier: GPL-3.0-or-later
// What a vertex overshot that a solid caught within the last step. sheet-collide has put it back without resistance, so
// the sheet around it does not know yet. Its step starts where the last one had taken it, and it makes up for that in
// the first stage: the sheet resists, and gets the displacement that it lacks, one step late. With SDIRK2 the vertex
// goes by the part γ/(1-γ) of it in the first stage, whose extrapolation is then the place where it is held, so that it
// rests in the second one, and the velocities at the end know nothing of it.
#pragma once
#include <span>

#include "libsheet/energy/state.h"

namespace sheet {

// Puts vertices back to where the last step had taken them, `by` [m] one a vertex; but none beside a triangle that this
// turns round by more than 60 degrees, halves, or doubles. Where none is left, state.overshoot is empty.
void put_back(State& state, std::span<const Vector3> by);

// Undoes it.
void forget_overshoot(State& state);

} // namespace sheet
