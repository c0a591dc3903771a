// SPDX-License-Identifier: GPL-3.0-or-later
// Inflows that begin with a fold, are no sheets, come out in ribs, or run into a sheet at rest.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of each inflow whose liquid moves across the sheet at the inlet (more than 60 degrees from its plane, in the mean),
// and against gravity, so that it comes down on the sheet; and of each that is thicker than its inlet is wide.
// Of those that a belt draws out within less than an edge, and those that flow in so much faster than the sheet starts
// that it is compressed there. Of those that flow in along a bath, at another height than that at which the sheet
// floats: the middle of a sheet of thickness h is rho h/rho_bath under the level, as the bath sees it; and of those
// that flow in along a solid that carries them, but with their middle 0.75 to 1.5 thicknesses off it, and bring more
// than a layer of their thickness carries off.
[[nodiscard]] std::vector<std::string> inflow_warnings(const Scene& scene, const formats::Frame& first);

} // namespace sheet
