// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets of which every vertex is held, as where a region is too large by mistake.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Where [[hold]]s that are for ever hold all of the first frame in all directions, and nothing comes in later; else "".
[[nodiscard]] std::string held_whole_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
