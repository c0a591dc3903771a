// SPDX-License-Identifier: GPL-3.0-or-later
// Frames as meshes for other programs.
#pragma once
#include "formats/cpp/foreign_mesh.h"
#include "formats/cpp/stream_frame.h"

namespace sheet {

// The frame's mesh with "thickness" [m] per triangle (volume / area) and per vertex (all volume around it / all area
// around it: the mean weighted by area; 0 where there are no triangles), and every array of numbers at vertices and
// triangles under its own name. Integers above 2^53 are rounded. Arrays at place edge and frame have no counterpart.
// Precondition: the frame obeys the format's rules (StreamReader::Values::check).
[[nodiscard]] formats::ForeignMesh to_foreign_mesh(const formats::Frame& frame);

// The closed outer surface (solidify.h); arrays at vertices go to both sides, those at triangles too, and to the rim
// beside them, but for sums (rule conserve), which are left out.
// Throws Error (bad_input) unless the frame is an oriented manifold.
[[nodiscard]] formats::ForeignMesh to_solid_mesh(const formats::Frame& frame);

// Adds an array "normal" of unit vectors at points, in place of one that there is: triangles weighted by their angles;
// 0 without triangles.
void add_normals(formats::ForeignMesh& mesh);

} // namespace sheet
