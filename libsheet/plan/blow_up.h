// SPDX-License-Identifier: GPL-3.0-or-later
// When pressure inflates a sheet to any size.
#pragma once
#include <optional>

#include "libsheet/scene/scene.h"

namespace sheet {

// The time at which the scene's pressure has blown a sheet up [s], without inertia and without what resists beside
// viscosity; none where no closed form is known, or the sheet does not blow up. With r the radius, h the thickness and
// mu the viscosity, the volume of liquid constant:
//   sphere, constant pressure p: dr/dt = p r²/(12 mu h), so 4 mu h/(p r); caps likewise, in about that time
//   sphere, p = value (reference/r)²: 12 mu h/(p r)
//   tube, constant pressure, its length kept or its ends free: 2 mu h/(p r)
[[nodiscard]] std::optional<double> blow_up_time(const Scene& scene);

} // namespace sheet
