// SPDX-License-Identifier: GPL-3.0-or-later
// What the sheet lacks around vertices that a solid caught (libsheet/energy/overshoot.h), as a frame carries it
// (formats/sheet.md, section 5, touch_overshoot).
#pragma once
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"

namespace sheet {

// By which way the sheet has gone on beside a vertex [m], and how much time there is to make up for that [s].
struct Overshoot {
  Vector3 way = Vector3::Zero();
  double time = 0;
};

// The time that there is, of the length of the step in which a vertex was caught: as the sheet has gone on for half of
// that step in the mean, it makes up for it as fast as it came.
inline constexpr double time_to_make_up = 0.5;

// One a vertex; none: all are 0. Where the frame says no time, it is that after the step that made it.
[[nodiscard]] std::vector<Overshoot> overshoots(const formats::Frame& frame);

// Writes them into a frame that has its time and start_time; takes arrays away that say nothing.
void put_overshoots(std::span<const Overshoot> overshoots, formats::Frame& frame);

} // namespace sheet
