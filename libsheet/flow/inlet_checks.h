// SPDX-License-Identifier: GPL-3.0-or-later
// Whether liquid can flow in at an inlet.
#pragma once
#include <span>

#include "libsheet/flow/inlet.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Throws Error (bad_input) where the inflow, now or (as long as nothing has entered) at any later time, would flow out
// of the sheet or along the inlet, or where a [[hold]] that is in force holds all of the inlet along an axis in which
// the inflow moves, or moves all of it. `inflow` is one of the scene's, `chains` its inlet's.
void check_inlet(const formats::Frame& frame, const Scene& scene, const scene::Inflow& inflow,
                 std::span<const InletChain> chains);

// Throws Error (bad_input) where triangles at this inlet pass through others: something lies in its mouth.
void check_room(const formats::Frame& frame, const Scene& scene, std::size_t number);

} // namespace sheet::flow
