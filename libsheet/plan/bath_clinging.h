// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that start above a bath that clings, which pulls them down from any height.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// "" where the bath does not cling, or nothing is farther above its level than three thicknesses.
[[nodiscard]] std::string bath_clinging_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
