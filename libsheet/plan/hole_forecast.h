// SPDX-License-Identifier: GPL-3.0-or-later
// Where holes at inclusions ([tear] sites) are to be expected, and what a scene with them, or with drops, lacks.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/explain.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// The mean thickness of a sheet of the first frame's volume, thinned evenly, when its first hole opens [m]: that of the
// law exp(-V N(h)), h_1 = at_thickness (sites V)^(1/m) Γ(1 - 1/m), for exponents m above 1; below, where there is no
// mean, its median, at_thickness (sites V/ln 2)^(1/m). Nothing in scenes without sites.
[[nodiscard]] std::vector<scene::Scale> hole_scales(const Scene& scene, const formats::Frame& first);

// What is wrong with such a scene: nothing draws holes open; several open at once at the start.
[[nodiscard]] std::vector<std::string> hole_warnings(const Scene& scene, const formats::Frame& first);

} // namespace sheet
