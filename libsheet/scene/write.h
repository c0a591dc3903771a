// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

// The canonical text of a scene: SI numbers as their shortest decimals, defaults that matter written out, tables in a
// fixed order, file names as they stand in the Scene. parse_scene reads it back to an equal Scene; equal scenes give
// equal text.
[[nodiscard]] std::string to_toml(const Scene& scene);

} // namespace sheet::scene

namespace sheet {
using scene::to_toml;
} // namespace sheet
