// SPDX-License-Identifier: GPL-3.0-or-later
// How wide solids are for what lies on them.
#pragma once
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// At least [m]: the radius of what is round, the narrower side of a box's largest face. Infinite for half-spaces, and
// for meshes, of which it is not known.
[[nodiscard]] double width_of(const SolidShape& shape);

} // namespace sheet::scene
