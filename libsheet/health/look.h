// SPDX-License-Identifier: GPL-3.0-or-later
// What a frame by itself shows of trouble.
#pragma once
#include <optional>
#include <vector>

#include "libsheet/health/record.h"
#include "libsheet/scene/scene.h"

namespace sheet::health {

// Thin places, threads, sharp triangles, edges longer than folds or than the solids that they lie on, short steps,
// crumbs: those beyond the limits of trouble.cpp. Judged by the frame alone, so that a run that is gone on with sees
// the same. scene: the frame's, or null; then only what needs none is judged. Takes some 60 ns a triangle.
[[nodiscard]] std::vector<Observation> look(const formats::Frame& frame, const Scene* scene);

// Volume that the frame has won (> 0) or lost since the one before, and that no account explains [m^3].
[[nodiscard]] double unexplained_volume(const formats::Frame& before, const formats::Frame& after);

} // namespace sheet::health
