// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid that is poured over tiers, as of a cake or stairs: each is filled before it overruns the next one.
#pragma once
#include <cstddef>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// When that inflow has come over the edge of the last tier [s]; 0 if it flows along less than two, one below the other.
// A level tier is filled by a layer whose flux q [m²/s] is that over its edge, L away from where it lands [Huppert
// 1982]:
//   h⁴ = 12 μ q x/(ρ g), x from the edge, in the mean 4/5 of h(L); on a slope h³ = 3 μ q/(ρ g_t) if that is less.
// It goes where the inflow does, as wide as the inlet; if that goes straight down, to the nearest side and all around.
[[nodiscard]] double time_over_tiers(const Scene& scene, const formats::Frame& first, std::size_t inflow);

} // namespace sheet
