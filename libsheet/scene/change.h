// SPDX-License-Identifier: GPL-3.0-or-later
// A scene changed in the middle of a run.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace sheet::scene {

// The text of a frame's scene, canonical, after settings as those of --set (read.h). Throws Error: bad_input (what
// sheet-init would refuse), usage (what the frame has settled: the sheet, which holds, solids and inflow there are and
// what they hold, and where the solids are at the frame's time t [s]).
[[nodiscard]] std::string changed_scene(std::string_view text, std::span<const std::string> sets, double t);

} // namespace sheet::scene
