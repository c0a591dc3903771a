// SPDX-License-Identifier: GPL-3.0-or-later
// Thick narrow streams whose folds would close, but stay layers without [merge] (docs/everyday.md).
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of the first inflow that is at most eight times as wide as thick, falls on a solid along which it flows, and piles up
// there, where the weight of its layers closes folds well before `until` [s]. "" if none does, or with [merge].
[[nodiscard]] std::string thick_stream_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
