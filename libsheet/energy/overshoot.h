// SPDX-License-Identifier: GPL-3.0-or-later
// What a vertex overshot that a solid caught within a step. sheet-collide has put it back without resistance, so the
// sheet around it does not know yet. The next step starts where that one had taken it, and it makes up for that in the
// first stage: the sheet resists, and gets the displacement that it lacks, one step late. With SDIRK2 the vertex goes
// by the part γ/(1-γ) of it in the first stage, whose extrapolation is then the place where it is held, so that it
// rests in the second one, and the velocities at the end know nothing of it.
//
// It is made up for about as fast as it came, in half the time of the step in which it was caught: a shorter step takes
// its part of it, and the next ones the rest. All of it in a step a hundred times as short would throw what is beside
// it a hundred times as fast.
#pragma once
#include <vector>

#include "libsheet/energy/state.h"

namespace sheet {

// Lets the steps make up for these, one a vertex; but not beside a triangle that they turn round by more than 60
// degrees, halve, or double. Where none is left, state.to_make_up is empty.
void make_up_for(State& state, std::vector<Overshoot> overshoots);

// How a step of this length [s] starts: vertices put back by their part of that to where the sheet takes them to be
// (`overshoot`), and what is left to make up for after it.
[[nodiscard]] State put_back(const State& state, double dt);

// None is made up for.
void forget_overshoot(State& state);

} // namespace sheet
