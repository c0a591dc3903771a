// SPDX-License-Identifier: GPL-3.0-or-later
// What is doubtful about a scene's contacts: liquid that sticks where it is likely meant to flow, and sheets that fold
// or pile up though nothing keeps them from passing through themselves.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// `until`: the end of the run [s]. Each names solid and remedy. As liquid is meant to flow counts
//   - on an inclined solid: a layer of the sheet's thickness h, that ran down it for that time, would run more than
//     three thicknesses, U = rho g h² sin(slope)/(3 mu)
//   - under an inflow that lands on a solid at rest: spreading on a level one it would run more than five thicknesses,
//     (rho g q³/(3 mu))^(1/5) t^(4/5), q what flows in per width [Huppert 1982, J. Fluid Mech. 121]
// What folds or piles up: piling.h; besides, several sheets that may meet, and a free sheet that falls over one solid
// onto others.
[[nodiscard]] std::vector<std::string> contact_warnings(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
