// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that end before heat has done anything.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Where viscosity depends on temperature and the run ends, at `until` [s], before a tenth of the least of the times in
// which faces or solids cool or warm what is there (scene/explain_heat.h: heat_scales), and its viscosity is within a
// factor of 1.5 of what it was: it flows throughout as it starts. "" where liquid flows in, as that comes at the
// start's temperature again and again, and where that time is a thousand runs.
[[nodiscard]] std::string late_heat_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
