// SPDX-License-Identifier: GPL-3.0-or-later
// What parts of triangles leave to the triangles that they lie on: volume, momentum and place. SI units.
//
// A part of the volume v that lies at the distance g above triangle t, on the side of its normal n, adds v to t, and at
// each corner of t a third of its mass, with the mean velocity of its own corners and a third of g v n of moment. So
// volume and momentum stay, and the middle surface of what has received moves by (Σ g v/3 n)/(volume at the corner)
// towards what it has received: the centre of mass stays along n. Kinetic energy falls by that of the relative motion.
// Other arrays by their transfer rules: conserve adds, interpolate and mean are means by mass, the others stay.
#pragma once
#include <span>

#include "formats/cpp/stream_frame.h"
#include "libsheet/flow/lying.h"

namespace sheet::flow {

// Moves what the parts say in a frame whose mesh stays. Triangles that have given all have the volume 0 afterwards and
// must go. Returns how far each vertex is to move, one a vertex [m]; positions are as before.
[[nodiscard]] std::vector<Vector3> deposit(formats::Frame& frame, std::span<const Lying> parts);

} // namespace sheet::flow
