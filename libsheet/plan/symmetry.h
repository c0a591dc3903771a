// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that stand in a plane about which everything is symmetric: nothing pushes them out of it, so what comes down
// on a solid grows thicker in its plane instead of folding. What differs by less than a thousandth of the sheet's
// thickness is the same here: too little to fold it before it has grown thick.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "libsheet/scene/explain.h"

namespace sheet {

// The numbers of the flat sheets that gravity brings down each in its own plane, where all is symmetric about that
// plane until they meet something: no perturbation of positions and no motion to one side, and both faces meet the same
// on their way.
[[nodiscard]] std::vector<std::size_t> sheets_in_their_planes(const Scene& scene);

// Settings, as `sheet-init --set` takes them, that give those of these sheets that have no perturbations noise of a
// hundredth of their thickness; measured: of each sheet of the scene.
[[nodiscard]] std::vector<std::string> small_noise(const Scene& scene, std::span<const std::size_t> sheets,
                                                   std::span<const scene::Measured> measured);

} // namespace sheet
