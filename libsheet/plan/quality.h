// SPDX-License-Identifier: GPL-3.0-or-later
// How finely a scene is computed: one word for the lengths of its edges and the errors of its steps together.
#pragma once
#include "libsheet/scene/scene.h"

namespace sheet {

enum class Quality { draft, normal, fine };

// The scene with its sheets' edges (or segments) as long as the quality wants them: draft takes edges of twice the
// length, but none that is too long to make the shape, fine of half of it. Meshes stay as they are.
[[nodiscard]] Scene at_quality(Scene scene, Quality quality);

// The error of a step that is allowed, in lengths of the edges: three times that of normal runs for a draft, 0.3 times
// for fine ones.
[[nodiscard]] double tolerance_at(Quality quality);

} // namespace sheet
