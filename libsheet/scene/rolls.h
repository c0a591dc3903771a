// SPDX-License-Identifier: GPL-3.0-or-later
// Holds whose region stays in space (Hold::roll): what enters is held from then on, what leaves is let go.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

[[nodiscard]] bool has_rolls(const Scene& scene);

// Whether the forces of holds and solids are to be written: those of rolls always are.
[[nodiscard]] bool wants_forces(const Scene& scene);

// Sets the frame's array hold for the rolls that are in force. A vertex is taken, and let go, half the mean length of
// its edges outside the region: so the place where a mesh begins to be held is the region's border in the mean.
void follow_rolls(const Scene& scene, formats::Frame& frame);

} // namespace sheet::scene
