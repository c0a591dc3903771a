// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a frame has the temperatures that its scene is about.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Throws Error (bad_input) where a scene with heat has a frame without temperatures, or with some that are too high to
// compute with, above 1e5 K.
void check_temperatures(const Scene& scene, const formats::Frame& frame);

} // namespace sheet::scene
