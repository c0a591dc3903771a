// SPDX-License-Identifier: GPL-3.0-or-later
// What is doubtful about the meshes of a scene, though it can be computed with.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of a mesh that is longer than a sheet or a solid is likely to be: that its scale may be wrong; else "".
[[nodiscard]] std::string hint_of_scale(const std::string& what, double length);

// What gives edges of that length: a key of the scene, or where all sheets are meshes, which are taken as they are,
// sheet-remesh.
[[nodiscard]] std::string setting_of_edges(const Scene& scene, double length);

// Of meshes of sheets whose borders lie on each other but are not joined, as where each triangle has vertices of its
// own: with the place and the remedy; else "".
[[nodiscard]] std::string seam_warning(const Scene& scene, const formats::Frame& first);

// Of the first frame's meshes: borders that lie on each other but are not joined, pieces that nothing joins, needles,
// solids whose numbers may be millimetres, and those that are narrower than edges are long. Each with place and remedy.
[[nodiscard]] std::vector<std::string> mesh_warnings(const Scene& scene, const formats::Frame& first);

} // namespace sheet
