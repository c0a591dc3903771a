// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a scene's sheets can come together, judged before anything is run.
#pragma once
#include <vector>

#include "libsheet/plan/landing.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Two of them may, unless they start and fall farther apart than the larger one is wide and nothing takes them to each
// other: no hold, solid or surface moves, none lands on a slope, has a velocity of its own, grows by an inflow, floats
// or is blown. all: the first frame's landings.
[[nodiscard]] bool sheets_may_meet(const Scene& scene, const std::vector<Landing>& all);

} // namespace sheet
