// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that a scene means to come off a solid, though it says no [contact] adhesion, so that nothing ever does.
#pragma once
#include <optional>
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct Parting {
  std::string why; // which solid, and what it does with the sheet
  double adhesion; // at which it comes off: half of the sheet's weight by area, rho g h/2 [Pa]
  bool thrown;     // up, so that it may come down on the solid again
};

// The first of these that happens before the end of the run, `until` [s], to what lies on a solid or lands on it:
//   - the solid throws it up: in free flight from some time on it would get farther than its thickness above the solid
//   - a belt carries it past the solid's end, where the belt does not go on
//   - the solid turns it under itself, as a roll that a film runs over does; not of what lies wholly on the solid, or
//     starts round it, in a layer that surface tension carries, 2 sqrt(gamma/(rho g)) thick, or that a roll or drum
//     which turns on carries round, 0.7 (nu U/g)^½ thick, U the speed of its surface [Moffatt 1977]
//   - it slides, runs or is drawn over an edge in the open (over_edge.h)
// Of what is warmed until it flows, as it is then. Nothing where the scene has an adhesion, or no gravity.
[[nodiscard]] std::optional<Parting> must_part(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
