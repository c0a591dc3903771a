// SPDX-License-Identifier: GPL-3.0-or-later
// Which volumes a sheet of a scene encloses at the start.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Numbers the pieces of this sheet of the scene, whose frame it is, where each encloses a volume for itself or not all
// sheets do (sheet/enclosures.h). Throws Error (bad_input) where one of several pieces is open.
void number_enclosures(const Scene& scene, const scene::SheetTable& table, formats::Frame& frame);

} // namespace sheet
