// SPDX-License-Identifier: GPL-3.0-or-later
// Planes that stand across gravity where that is along no axis of coordinates, as where a slope is meant.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Of a plane without `normal`, or with that which is the default, under gravity that is tilted by a degree or more
// while no sheet is turned: what it means, and how to make it a slope. None of other solids.
[[nodiscard]] std::optional<std::string> level_plane_in_doubt(const Scene& scene, std::size_t solid);

} // namespace sheet::scene
