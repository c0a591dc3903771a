// SPDX-License-Identifier: GPL-3.0-or-later
// The ring of stages that a scene needs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

struct RingStage {
  std::string program; // and its options
  std::string without; // what becomes of the scene without it; "": it is wise, but nothing is missing
};

// In their order: layers become one, the mesh is mended and new liquid comes in before the step, and nothing stands
// behind sheet-collide, so that what is kept has passed through nothing.
[[nodiscard]] std::vector<RingStage> ring_of(const Scene& scene);

// Joined by pipes.
[[nodiscard]] std::string pipeline_of(const Scene& scene);

// What the pipeline leaves undone of what the scene says, a line each, with the ring that would do it; "" if nothing.
// A pipeline without sheet-step is not judged.
[[nodiscard]] std::string missing_stages(const Scene& scene, std::string_view pipeline);

} // namespace sheet::scene
