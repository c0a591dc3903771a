// SPDX-License-Identifier: GPL-3.0-or-later
// Two sheets in one frame.
#pragma once
#include "formats/cpp/stream_frame.h"

namespace sheet {

// Adds the vertices and triangles of `more` behind those of `frame`. Arrays of vertices and triangles that only one of
// them has are zero for the other (start_position: where the vertices are), edge arrays of `frame` are zero for the new
// edges, edge arrays of `more` and arrays of place frame are left out. Time and step stay.
void append(const formats::Frame& more, formats::Frame& frame);

} // namespace sheet
