// SPDX-License-Identifier: GPL-3.0-or-later
// From a scene to the first frame: shape, mesh, place, thickness, perturbations, holds.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// The frame at time 0, with the scene's canonical text in it. Throws Error (bad_input) where the scene asks for what
// its shape cannot give (an edge length too large, a hold that holds nothing), Error (io) where a mesh file cannot be
// read.
[[nodiscard]] formats::Frame build_frame(const Scene& scene);

// Whether what was passed over or mended in a mesh file is told.
enum class Notes { told, silent };

// The scene's sheet `number` alone, without the scene's text. Errors as above.
[[nodiscard]] formats::Frame build_sheet(const Scene& scene, std::size_t number, Notes notes = Notes::told);

// Puts a sheet's arrays behind those of the frame's. What it encloses gets numbers of its own.
void append_sheet(const formats::Frame& sheet, formats::Frame& frame);

} // namespace sheet
