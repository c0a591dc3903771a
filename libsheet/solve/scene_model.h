// SPDX-License-Identifier: GPL-3.0-or-later
// From a frame and the scene in it to what the Stepper understands, and back.
#pragma once
#include <memory>

#include "formats/cpp/stream_frame.h"
#include "libsheet/energy/model.h"
#include "libsheet/energy/state.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"
#include "libsheet/solve/holding_forces.h"

namespace sheet {

// The frame's positions [m], velocities [m/s] and volumes [m³] on that connectivity (which must be the frame's).
[[nodiscard]] State state_of(const formats::Frame& frame, std::shared_ptr<const Connectivity> mesh);

// Writes the end of a step into the frame: positions, velocities, time, step + 1, and where the step started.
void put_state(const State& state, formats::Frame& frame);

// Adds to the frame's account "heat.moved" [J] what the step moved: by viscosity generated, lost through the upper and
// the lower face, lost to solids; nothing without temperatures.
void put_heat_moved(const State& state, formats::Frame& frame);

// Lets the step make up for what vertices overshot that a solid caught (arrays "touch_overshoot", and
// "touch_overshoot_time" where that was not in the last step; energy/overshoot.h), where the model holds them on it;
// but none of a contact spring, whose forces would be those of another place.
void make_up_for_overshoot(const formats::Frame& frame, const Model& model, State& state);

// Writes the forces of solids on what touches them, [N] a vertex (array "touch_force"), the part of them that holds
// external forces, if that is known ("touch_load"), and, if wanted, those of holds ("hold_force") and the sum of those
// of each of the scene's solids ("solid_force"); takes the arrays away where there are none.
void put_reactions(const HoldingForces& reactions, bool of_holds, std::size_t solids, formats::Frame& frame);

// The terms that the scene asks for, and its holds that are in force at the frame's time: those of the scene's [[hold]]
// tables (array "hold"), the vertices that touch a solid and move with it (array "touch"), those in the inlet (array
// "inlet", until the inflow ends); contact springs (arrays "contact_..."). Bending is as `bending` says, unless the
// scene wants none. Reactions are wanted where the scene says at what tension the sheet parts from solids that it
// touches, or where rims do not retreat on a solid along which liquid flows. `solids`: the scene's, where liquid flows
// or slips on one of them (flows_on_solids), or where what sticks to one may be squeezed by another one
// (solids_squeeze), as it flows out from between them then; else not needed. Throws Error (bad_input) where the scene
// has too little for a model.
[[nodiscard]] Model model_of(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh, Bending bending,
                             bool arcs, const std::shared_ptr<const solid::Solids>& solids = nullptr);

// The same of a scene alone, as if all touched that can: for what its terms are (term_table.h), not to be stepped. It
// has one law of pressure, walls and a contact without vertices.
[[nodiscard]] Model model_of(const Scene& scene);

// The first time after t [s] at which a prescribed motion has a kink, a hold is released or the inflow ends; infinity
// if there is none. A step that does not pass it keeps its order.
[[nodiscard]] double next_event(const Scene& scene, double t);

} // namespace sheet
