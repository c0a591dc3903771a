// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces of a frame's sheet tension sees besides its middle surface ([model] faces): the rims at which it ends in
// the open, and what lies on solids, with one face.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/faces.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// No free rim is where the sheet goes on beyond its mesh, or something else says what happens there: inlets, rims that
// holds keep from moving outward (pinned ones, planes of symmetry, guides), welds, the planes of outflows. On solids
// with a contact angle, in the part of its two ends that touch, a rim is that angle's; on those without one the wetted
// face pulls as a free one, and the rim is free. What has layers or solids on both faces has neither rims nor slopes,
// what has one on one face has one that slopes (inner_faces.h).
[[nodiscard]] FreeFaces free_faces(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh);

} // namespace sheet::scene
