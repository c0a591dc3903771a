// SPDX-License-Identifier: GPL-3.0-or-later
// How steep solids are where sheets lie on them, or land.
#pragma once
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/explain.h"

namespace sheet {

// Those of each of the scene's sheets (first_frame.h), with the part of gravity along each solid where the sheet is
// steepest on it (`along`), if all of the sheet lies or lands there and liquid flows along it, and whether all of
// it lies on such solids. Where liquid flows in that is where the ways down from there are steepest, up to an edge, and
// not known of solids on which no vertex lies or lands.
[[nodiscard]] std::vector<scene::Measured> measured_on_solids(const Scene& scene, const formats::Frame& first);

} // namespace sheet
