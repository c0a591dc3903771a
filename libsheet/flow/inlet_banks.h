// SPDX-License-Identifier: GPL-3.0-or-later
// An inlet on a wall that is drowned (drowned_inlets.h) is an opening in a bank: what it brings spreads along the wall
// before it and to both sides, not round its ends and behind it, where it would fold between them and itself.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet::flow {

// Moves the rim that goes on from both ends of an inlet's strip, as far as it lies on a wall along which liquid flows
// and has come behind the strip's first row by less than half of the strip's width, along the wall to beside the row,
// and takes its velocity back from it. What is farther behind stays where it is, as does what would meet another layer
// on its way back. Bit for bit the same frame where no inlet is drowned. `solids`: the scene's. Throws Error
// (bad_input) where find_inlet does.
void hold_banks(formats::Frame& frame, const Scene& scene, const solid::Solids& solids);

} // namespace sheet::flow
