// SPDX-License-Identifier: GPL-3.0-or-later
// Planes and sheets that lie across gravity where that is along no axis of coordinates, as where a slope is meant.
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

// Of a plane without `normal`, or with that which is the default, under gravity that is tilted by a degree or more
// while no sheet is turned: what it means, and how to make it a slope. None of other solids.
[[nodiscard]] std::optional<std::string> level_plane_in_doubt(const Scene& scene, std::size_t solid);

// Of a flat sheet that lies in the coordinate plane most nearly across such gravity, as without `plane`, edge-on to a
// face of that outward normal (unit): what it means, and the plane along that face. None of other sheets.
[[nodiscard]] std::optional<std::string> sheet_edge_on_in_doubt(const Scene& scene, const Vector3d& face);

} // namespace sheet::scene
