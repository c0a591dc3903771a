// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that fill their form to its sides: sheet-collide keeps a rim off those.
#pragma once
#include <string>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// Of the solid beside which the sheet's free rim loses most: a rim that starts nearer to an upright face than an eighth
// of the thickness is put up to a quarter of it off that in the first step (solid_contact.h), unless it flows along
// another solid, and the layer becomes thicker by the room that it loses. "" where all solids together take less than a
// twentieth of its area.
[[nodiscard]] std::string beside_walls_warning(const Scene& scene, const formats::Frame& first);

} // namespace sheet
