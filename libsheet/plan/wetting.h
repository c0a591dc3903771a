// SPDX-License-Identifier: GPL-3.0-or-later
// Thin layers on solids that tension holds together, as nothing says how they wet.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of a sheet half of which lies at the start, with free rims, on solids along which it flows and which have no contact
// angle, so that the wetted face pulls like a free one, as at 180 degrees: a puddle stands there 2 sqrt(gamma/(rho g))
// high, and a thinner layer does not spread. Of angle theta it stands 2 sqrt(gamma/(rho g)) sin(theta/2) high
// [de Gennes 1985, Rev. Mod. Phys. 57]. "" where there is none, where tension moves nothing before `until` [s], or
// where a yield stress bears it.
[[nodiscard]] std::string wetting_warning(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
