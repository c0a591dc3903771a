// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a scene should ask for the tension of rims and slopes ([model] faces), and whether its mesh suits it.
#pragma once
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// `until`: the end of the run [s]. Without faces: where the sheet has free rims, or tears, and tension moves them by
// then by a tenth of what they are wide, gamma until/(mu h) > 0.1, or Oh = mu/sqrt(rho gamma h) < 1. With them: where
// the mesh is of right-angled triangles, for which slopes count 0.83 to 1.5 times (geometry/faces.h).
[[nodiscard]] std::vector<std::string> face_warnings(const Scene& scene, const formats::Frame& first, double until);

} // namespace sheet
