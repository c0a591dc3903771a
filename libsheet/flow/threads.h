// SPDX-License-Identifier: GPL-3.0-or-later
// Threads: what a sheet draws out to where edges can no longer follow. A strand narrower than half the shortest edge
// has triangles that are sharp however they are cut, which step by step take ever more iterations, and next to no
// liquid; in truth such a thread parts by its surface tension [Rayleigh 1878].
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/flow/shed.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Takes away the triangles of threads, and what hangs by them alone in pieces smaller than a crumb (tear_cuts.h); those
// in an inlet or held stay. A triangle is of a thread if it has no side above twice the shortest edge [m], a height
// below half of it, a section (that height times its thickness) below that squared, less than a thousandth of the mean
// volume, and if each of those that it hangs together with has a corner on a rim. With [tear] snap in the scene, also
// where the strand is narrower than that, from rim to rim (strand_width.h), and its section below that of a round
// thread of this width, 4/π of the square (geometry/faces.h), whatever the volume: such a thread falls into drops. What
// becomes of what has left: shed.h. Bit for bit the same frame if there is no thread.
Shed cut_threads(formats::Frame& frame, const Scene& scene, double shortest_edge);

} // namespace sheet::flow
