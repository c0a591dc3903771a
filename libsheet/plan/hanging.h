// SPDX-License-Identifier: GPL-3.0-or-later
// When what hangs by its own weight runs away.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// The time at which what hangs has been drawn out to any length by its weight [s], without inertia, with which it falls
// from then on. Where a strip is held, the weight below stays as the section A shrinks: with l = A0/A, D the length
// that hangs and rho g D the stress there at the start, dl/dt = l² rho g D/(3 mu) [Trouton 1906], so 3 mu/(rho g D). In
// general it is the integral of 1/rate over ln l, rate that of the stress l rho g D/3 (driven_rate.h). D is how far the
// sheet lies from what is held: all of a curtain, half of a strip that is held at both ends. None where not all holds
// stand for ever, be it that they turn about an upright axis, where something else carries or drives the sheet, but gas
// in it that presses less than it weighs, a solid is below it, tension holds it, it does not yield, or heat would
// change how it flows before.
[[nodiscard]] std::optional<double> runaway_time(const Scene& scene, const formats::Frame& first);

// What is over a solid's edge from the start, beside what is above a solid.
struct Overhang {
  std::size_t solid; // nearest to what hangs farthest
  double length;     // how far that is from what is above it [m]
  double time;       // as above, of a strip of that length that hangs from the edge [s]
};
// The farthest; what lies on a solid, be it below it, is not meant. None where all or nothing is above solids, or
// holds, pressure, a bath or tension carry the sheet, or it does not yield. all: of the sheet's vertices.
[[nodiscard]] std::optional<Overhang> overhang(const Scene& scene, const formats::Frame& first,
                                               const std::vector<Landing>& all);

} // namespace sheet
