// SPDX-License-Identifier: GPL-3.0-or-later
// Holds that press a sheet together until nothing is between them: there the sheet has no room, and a run stalls.
#pragma once
#include <cstddef>
#include <optional>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct HoldsMeet {
  std::size_t one, other; // their numbers, ascending
  double time;            // [s]
};

// The first two [[hold]]s that move straight on, or rest, start apart, and come nearer to each other by `until` [s]
// than the first frame's mean thickness. How far they are apart goes by boxes around what they hold, along those axes
// that both hold: no more than it is.
[[nodiscard]] std::optional<HoldsMeet> holds_meet(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
