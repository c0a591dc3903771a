// SPDX-License-Identifier: GPL-3.0-or-later
// Where layers of one liquid lie on each other there is no face between them, and so no surface tension: a heap of N
// folds has the 2 γ of one body, not 2 N γ. Contact springs say where.
#pragma once
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Of each vertex of a frame: how many of its two faces, 0 to 2, lie on other layers of its liquid; empty: none do, or
// layers do not flow along each other (layers_flow), and touch as solids do. A spring covers, at each of its corners,
// the face towards the other feature in the part of its weight there times the cosine between the spring and the
// sheet's normal (rims that meet edge-on cover nothing); all of a face is the most.
[[nodiscard]] std::vector<double> inner_faces(const Scene& scene, const formats::Frame& frame);

} // namespace sheet::scene

namespace sheet {
using scene::inner_faces;
} // namespace sheet
