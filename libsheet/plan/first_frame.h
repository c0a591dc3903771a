// SPDX-License-Identifier: GPL-3.0-or-later
// A scene's first frame, and what the stages will say of it before anything is run (sheet-init --check).
#pragma once
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/explain.h"

namespace sheet {

// The sheet of the scene; what lies within half its thickness of a solid along which liquid flows or slips touches it.
// Throws Error where the sheet, its holds, its inlet or such a solid cannot be made.
[[nodiscard]] formats::Frame first_frame(const Scene& scene);

// The same. Throws Error where sheet-init or a stage would refuse it: a hold or an inlet that is not
// there, an inlet along which or out of which liquid would flow, a solid's mesh that cannot be read or is none, a sheet
// that starts, or enters later, inside a solid, or passes through itself.
[[nodiscard]] formats::Frame checked_first_frame(const Scene& scene);

// Length (the root of its area) and mean thickness of the frame's sheets as one.
[[nodiscard]] scene::Measured measured(const formats::Frame& frame);

// From the lowest vertex down to the bath [m]; 0 where some of it is in the bath, or there is none.
[[nodiscard]] double height_above_bath(const Scene& scene, const formats::Frame& frame);
// Those of each of the scene's sheets, which starts so or enters later.
[[nodiscard]] std::vector<scene::Measured> measured_sheets(const Scene& scene, const formats::Frame& first);

} // namespace sheet
