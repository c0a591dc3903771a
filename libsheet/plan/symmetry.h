// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that stand in a plane about which everything is symmetric: to the last bit nothing pushes them out of it, so
// what comes down on a solid grows thicker in its plane instead of folding.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/explain.h"

namespace sheet {

// Whether gravity brings a flat sheet of that thickness [m] down in its own plane, and all is symmetric about that
// plane: no perturbation of positions and no motion to one side, and both faces meet the same on their way.
[[nodiscard]] bool stays_in_its_plane(const Scene& scene, const formats::Frame& first, double thickness);

// Settings, as `sheet-init --set` takes them, that give every sheet without perturbations noise of a ten-thousandth of
// its thickness; measured: of each sheet.
[[nodiscard]] std::vector<std::string> small_noise(const Scene& scene, std::span<const scene::Measured> measured);

} // namespace sheet
