// SPDX-License-Identifier: GPL-3.0-or-later
// Which vertices come off the solids that they touch. SI units.
#pragma once
#include "libsheet/collide/step_path.h"
#include "libsheet/solid/solids.h"

namespace sheet::collide {

// The vertices, ascending, that their solid pulls harder than the adhesion [Pa] times their area [m²], against the
// solid's outward normal at the end of the step. `force`: of the solid on each vertex that touches one [N] (array
// touch_force, formats/sheet.md); `load` (touch_load): what of it holds external forces, or empty. Where all around a
// vertex touches a solid along which liquid flows or slips, the load alone counts: a layer that is pushed together
// there arches, and pulls at the solid with what is in it, but no air gets between them.
[[nodiscard]] std::vector<std::uint32_t> pulled_off(const StepPath& path, const solid::Solids& solids,
                                                    std::span<const Vector3> force, std::span<const Vector3> load,
                                                    double adhesion, std::span<const double> area);

} // namespace sheet::collide
