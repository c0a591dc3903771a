// SPDX-License-Identifier: GPL-3.0-or-later
// How near the layers of a sheet lie to each other: looked for by rays out of its surface. Layers of two liquids are
// not near: they stay two bodies.
//
// Gaps are measured in widths: the thickness there, or that of the sheet on average if that is more.
#pragma once
#include <algorithm>
#include <vector>

#include "libsheet/render/world.h"

namespace sheet::render {

constexpr float narrow_gap = 0.5F; // layers touch all over up to this gap [widths],
constexpr float wide_gap = 2;      // and no more from this on

// How much two layers touch across a gap [widths], 0 to 1: falls linearly between those.
inline float closeness(float gap) { return std::clamp((wide_gap - gap) / (wide_gap - narrow_gap), 0.0F, 1.0F); }

struct NearLayers {
  std::vector<float> closeness; // of the sheet's vertices, on either side and one ring on: 0 to 1; empty: none touch
  std::vector<float> ahead;     // of the surface's points: the closeness of what is ahead along the normal
};

// `mean`: the sheet's thickness on average [m].
[[nodiscard]] NearLayers near_layers(const World& world, float mean);

// Of the surface's points where layers touch, 0 of others: the part of the ways out of there on which another layer is.
[[nodiscard]] std::vector<float> covered_by_others(const World& world, float mean, const NearLayers& near);

} // namespace sheet::render
