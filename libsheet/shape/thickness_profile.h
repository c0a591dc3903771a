// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness that changes over a sheet as the scene's rows say (libsheet/scene/scene.h).
#pragma once
#include "libsheet/geometry/types.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// [m], at a place [m] of a sheet that stands in `plane` around the origin, not yet rotated.
[[nodiscard]] double thickness_at(const Vector3& place, const scene::ThicknessProfile& profile, scene::Plane plane);

} // namespace sheet
