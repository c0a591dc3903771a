// SPDX-License-Identifier: GPL-3.0-or-later
// Rolls that nothing has come to, as where their regions are beside the sheet by mistake.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// A sentence for each [[hold]] with roll = true in whose region no vertex of the first frame lies.
[[nodiscard]] std::vector<std::string> idle_roll_warnings(const Scene& scene, const formats::Frame& first);

} // namespace sheet
