// SPDX-License-Identifier: GPL-3.0-or-later
// How far directors may lean from the normals of their triangles.
#pragma once
#include "libsheet/energy/holds.h"
#include "libsheet/energy/state.h"

namespace sheet {

// Turns directors back that lean by more than 80 degrees from the normal of a triangle of theirs: towards the mean of
// the normals, no further than there. Beyond 90 degrees heights fall again (geometry/director.h), so strain would have
// the wrong sign, and a director in a compressed sheet turns over at no cost. Only what later rates refer to changes,
// and that costs a viscous sheet no work. Clamped directors stand where they are held.
void limit_leaning(State& state, const std::vector<Hold>& holds);

} // namespace sheet
