// SPDX-License-Identifier: GPL-3.0-or-later
// What temperatures mean for a scene (sheet-init --check).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "libsheet/scene/explain.h"
#include "libsheet/scene/scales.h"

namespace sheet::scene {

// The scene with the liquid that it is at the start's temperature, by whose numbers it is judged; itself without heat.
[[nodiscard]] Scene as_it_starts(const Scene& scene);

// Of scenes with heat, else none. `scales`: those of the scene as it starts.
[[nodiscard]] std::vector<Scale> heat_scales(const Scene& scene, const Scales& scales);
[[nodiscard]] std::vector<DimensionlessNumber> heat_numbers(const Scene& scene, const Scales& scales);
// Of faces that cool long before the middle, though the profile across the thickness is a parabola.
[[nodiscard]] std::optional<std::string> warning_of_biot(const Scene& scene, const Scales& scales);

// How the viscosity goes with temperature, and what the faces do: for the list of what is modelled.
[[nodiscard]] std::string heat_in_words(const Scene& scene);

} // namespace sheet::scene
