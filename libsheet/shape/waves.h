// SPDX-License-Identifier: GPL-3.0-or-later
// The waves of a sheet's `perturbation` (libsheet/scene/scene.h) as fields.
#pragma once
#include "libsheet/scene/scene.h"
#include "libsheet/shape/perturb.h"

namespace sheet {

// At places [m] of the sheet that stands in its plane around the origin, not yet rotated.
[[nodiscard]] HeightField wave_field(const scene::Perturbation& perturbation, const scene::Wave& wave,
                                     const scene::SheetTable& table);

} // namespace sheet
