// SPDX-License-Identifier: GPL-3.0-or-later
// What falls beside all that should catch it, as where gravity points along another axis than the scene is drawn for,
// and what comes off solids below which there is nothing.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// "" unless there are solids, all at rest, and nothing but gravity moves the sheet, straight down, past all of them, on
// none of which it lies. Or where inertia is left out, nothing holds it, and it lies on none of the solids: that has
// no solution.
[[nodiscard]] std::string falling_past_warning(const Scene& scene, const formats::Frame& first);

// Of what is carried, runs or is drawn over the edge of a solid before `until` [s] (parting.h), where no other solid
// lies lower and nothing else takes it up: with an outflow that would, below all by the sheet's length; else "".
[[nodiscard]] std::string falling_on_warning(const Scene& scene, const formats::Frame& first, double until);

// Of a roll that lets go of what it draws where nothing takes that up: below are no solid and no bath, and no outflow
// is within three edges behind it, or looks down. That hangs from the roll and falls; else "".
[[nodiscard]] std::string falling_behind_rolls_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
