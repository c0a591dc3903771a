// SPDX-License-Identifier: GPL-3.0-or-later
// When what hangs by its own weight runs away.
#pragma once
#include <optional>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// The time at which what hangs has been drawn out to any length by its weight [s], without inertia, with which it falls
// from then on. Where a strip is held, the weight below stays as the section A shrinks: with l = A0/A, D the length
// that hangs and rho g D the stress there at the start, dl/dt = l² rho g D/(3 mu) [Trouton 1906], so 3 mu/(rho g D). In
// general it is the integral of 1/rate over ln l, rate that of the stress l rho g D/3 (driven_rate.h). D is how far the
// sheet lies from what is held: all of a curtain, half of a strip that is held at both ends. None where not all holds
// stand for ever, where something else carries or drives the sheet, a solid is below it, tension holds it, or it does
// not yield.
[[nodiscard]] std::optional<double> runaway_time(const Scene& scene, const formats::Frame& first);

} // namespace sheet
