// SPDX-License-Identifier: GPL-3.0-or-later
// What is closed in a bath, and has nothing in it that withstands.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// "" unless there is a bath and weight, and a piece of the sheet is closed and reaches under the level, without
// pressure in it.
[[nodiscard]] std::string bath_crushing_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
