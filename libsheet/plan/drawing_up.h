// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that come to what lies on another solid, and rise again: they draw nothing up, as a sheet stays with the solid
// that it touched first (docs/flow-on-solids.md). What has touched none before goes with them.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of the first solid that touches, not from below, what lies on another one at the start, and is later, before `until`
// [s], more than a thickness higher above it; but not of one that only rolls on. "" if none does.
[[nodiscard]] std::string drawing_up_warning(const Scene& scene, const formats::Frame& first, double until);

// Of the first solid that comes from above to what spans a gap beside what lies on solids, and goes on, before `until`
// [s]: that stays with the tool, and is drawn out behind it, where the scene has no [contact] adhesion. "" if none
// does.
[[nodiscard]] std::string drawing_along_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
