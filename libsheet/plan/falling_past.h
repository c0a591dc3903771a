// SPDX-License-Identifier: GPL-3.0-or-later
// What falls beside all that should catch it, as where gravity points along another axis than the scene is drawn for.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// "" unless there are solids, all at rest, and nothing but gravity moves the sheet, straight down, past all of them.
[[nodiscard]] std::string falling_past_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
