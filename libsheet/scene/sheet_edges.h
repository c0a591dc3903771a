// SPDX-License-Identifier: GPL-3.0-or-later
// How long the edges of sheets are that the scene gives different ones: the frame's array "remesh.sheet_edge" has for
// each triangle what its sheet states [m]. Other scenes have no such array.
#pragma once
#include <optional>
#include <span>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// The shortest that a sheet of the scene states [m].
[[nodiscard]] std::optional<double> shortest_stated_edge(const Scene& scene);

// Adds the array, of a frame that is wholly of that sheet, if sheets state different lengths. A sheet that states none
// has the shortest.
void put_sheet_edge(const Scene& scene, const SheetTable& sheet, formats::Frame& frame);

// Of each triangle [m]; empty: all alike.
[[nodiscard]] std::span<const double> sheet_edges(const formats::Frame& frame);

} // namespace sheet::scene
