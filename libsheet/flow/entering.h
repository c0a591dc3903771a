// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that enter while others are there already: each [[sheet]] with `enters`, in the order of these times, of two
// at one time the first of the scene's. The frame array `entered` counts those that have.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// Whether the sheet of that name is there.
[[nodiscard]] bool has_entered(const Scene& scene, const std::string& name, const formats::Frame& frame);

// Adds the sheets whose time has come, and gives their volume [m³], which the array `emit.volume` counts as well.
double let_enter(formats::Frame& frame, const Scene& scene);

} // namespace sheet::flow
