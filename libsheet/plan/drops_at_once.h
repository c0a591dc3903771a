// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that are drops from their first step on, as their edges are long ([tear] drops, flow/shed.h).
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Where there are such, of those of the first frame and those that enter later: where the first one starts, how many
// there are, and how long edges may be for it to stay a sheet; else "".
[[nodiscard]] std::string drops_at_once_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
