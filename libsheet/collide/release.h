// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices come off the solids that they touch. SI units.
#pragma once
#include "libsheet/collide/step_path.h"
#include "libsheet/solid/solids.h"

namespace sheet::collide {

// The vertices, ascending, that their solid pulls harder than the adhesion [Pa] times their area [m²], against the
// solid's outward normal at the end of the step. `force`: of the solid on each vertex that touches one [N] (array
// touch_force, formats/sheet.md).
[[nodiscard]] std::vector<std::uint32_t> pulled_off(const StepPath& path, const solid::Solids& solids,
                                                    std::span<const Vector3> force, double adhesion,
                                                    std::span<const double> area);

} // namespace sheet::collide
