// SPDX-License-Identifier: GPL-3.0-or-later
// How long edges shall be: as long as a sheet states, or, of a mesh and of counts, as they are in the mean at its
// start. The frame's array "remesh.sheet_edge" has for each triangle that of its sheet [m], where a scene has several
// sheets that do not all state the same. Other scenes have no such array.
#pragma once
#include <optional>
#include <span>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// The mean length of the frame's edges, those between triangles counted twice [m]; 0 of a frame without triangles.
[[nodiscard]] double mean_edge(const formats::Frame& frame);

// The shortest that a sheet of the scene states [m]; none if there is one that states none.
[[nodiscard]] std::optional<double> shortest_stated_edge(const Scene& scene);

// Adds the array, of a frame that is wholly of that sheet, if the scene's frames have it.
void put_sheet_edge(const Scene& scene, const SheetTable& sheet, formats::Frame& frame);

// Of each triangle [m]; empty: all alike.
[[nodiscard]] std::span<const double> sheet_edges(const formats::Frame& frame);

// The shortest of these, or, if there are none, the mean edge [m].
[[nodiscard]] double shortest_own_edge(const formats::Frame& frame);

} // namespace sheet::scene
