// SPDX-License-Identifier: GPL-3.0-or-later
// Inlets (inlet.h) on walls along which liquid flows, where it comes in faster than a layer as thick as that runs away.
// It piles up before the inlet, until the inlet is under it, and enters as deep as the layer is before each vertex of
// the border (scene/inlet_depth.h). With the depth H the strip rises there, as the middle of what lies before it does:
// to (H - h)/2 above where the scene has it, h the inflow's thickness. Left below, it would be folded over by what it
// is to push on.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet::flow {

// Sets depths and heights of the frame's inlets by what lies before them, each depth by at most a twentieth: the
// greatest mean thickness before that vertex of any of the first four rows of triangles beyond the strip whose
// corners touch a wall along which liquid flows; at the ends of an inlet, that of all four. As much enters as
// before, and the strip touches that wall. Where it would meet what has come to lie there, all stays as it is. Bit
// for bit the same frame where no inlet is drowned. `solids`: the scene's.
void drown_inlets(formats::Frame& frame, const Scene& scene, const solid::Solids& solids);

} // namespace sheet::flow
