// SPDX-License-Identifier: GPL-3.0-or-later
// Do two frames belong to one run?
#pragma once
#include "formats/cpp/stream_frame.h"

namespace sheet {

// True if `newer` may have come from `older` by further steps: all that was done to the older one (its provenance) was
// done to the newer one, too, at least as often, and they have the same scene, or a --set has changed it in between.
[[nodiscard]] bool same_run(const formats::Frame& older, const formats::Frame& newer);

} // namespace sheet
