// SPDX-License-Identifier: GPL-3.0-or-later
// What drops weigh.
#pragma once
#include <span>
#include <vector>

#include "libsheet/scene/scene.h"
#include "libsheet/sheet/drops.h"

namespace sheet::scene {

// Densities of their liquids [kg/m³]. Throws Error (bad_input) for a drop of a liquid that the scene does not have.
[[nodiscard]] std::vector<double> densities_of(std::span<const Drop> drops, const Scene& scene);

} // namespace sheet::scene
