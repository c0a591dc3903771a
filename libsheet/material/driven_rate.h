// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a liquid is strained by a stress: its flow curve τ(γ̇), read the other way round.
#pragma once
#include "libsheet/material/flow_curve.h"
#include "libsheet/material/liquid.h"

namespace sheet {

// γ̇ of τ(γ̇) = `stress` >= 0 [Pa] in [1/s]; 0 of what yields at or below its yield stress, infinity of what is
// inviscid.
[[nodiscard]] double driven_rate(const Liquid& liquid, double stress);
// By its flow curve, for many stresses.
[[nodiscard]] double driven_rate(const Liquid& liquid, const FlowCurve& curve, double stress);
// The same, by order of magnitude, of what is stretched by a tension, of which a liquid that yields bears
// `borne` times its yield stress: sqrt(3) in a strip, 2 where a side is held [von Mises 1913].
[[nodiscard]] double stretching_rate(const Liquid& liquid, double tension, double borne);

} // namespace sheet
