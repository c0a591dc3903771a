// SPDX-License-Identifier: GPL-3.0-or-later
// Solids whose motions take them into each other, or into what is held or flows in, judged before anything is run.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// A sentence for each two solids of which one moves, that start apart, and that by `until` [s] are in each other by
// more than a tenth of the first frame's thickness: what lies between them has nowhere to go. Found at some hundred
// points of their surfaces and some hundred times, so what is told is true, and what is thin or quick may be missed.
[[nodiscard]] std::vector<std::string> warnings_of_solids_that_meet(const Scene& scene, const formats::Frame& first,
                                                                    double until);

// Likewise for each solid and each [[hold]] along all axes or inlet, of which one moves. What is prescribed does not
// give way: the solid stands in the liquid there.
[[nodiscard]] std::vector<std::string>
warnings_of_solids_that_meet_what_is_held(const Scene& scene, const formats::Frame& first, double until);

struct HoldInSolid {
  std::size_t hold, solid; // their numbers
  double time;             // [s]
};

// The first such [[hold]] and solid: there sheet-collide ends the run.
[[nodiscard]] std::optional<HoldInSolid> hold_in_solid(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
