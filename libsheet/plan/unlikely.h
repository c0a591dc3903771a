// SPDX-License-Identifier: GPL-3.0-or-later
// Values that no liquid on Earth has, as where a number was written in other units than SI.
#pragma once
#include <string>
#include <vector>

#include "libsheet/scene/scene.h"

namespace sheet {

// Of densities, surface tensions, flow indices, gravity, speeds at which liquid flows in or starts, and belts that move
// out of their planes.
[[nodiscard]] std::vector<std::string> unlikely_values(const Scene& scene);

} // namespace sheet
