// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets that slide, run or are drawn over the edge of a solid, beyond which nothing takes them up.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/scene.h"

namespace sheet {

struct OverEdge {
  std::string why; // what goes over the edge of which solid
  double time;     // from when on [s]
  double density;  // of the liquid, less what a bath bears of it if it floats past a wall's end [kg/m³]
};

// Of what lies or lands on boxes, cylinders and meshes along which it slips or flows, the first that gets there before
// `until` [s], on the way
//   - down the slope, of the solid as it stands when it has turned: from rest without drag where it slips, with the
//     speed of a layer where it flows (scene/layer_scales.h), as thick as the sheet, or as it carries what flows in
//   - to where a hold goes
//   - to where an inflow drives it, along an upright wall at rest, past the wall's end
//   - away from the axis of a solid that turns on, with the speed of a layer that its turning drives, where that pulls
//     more than gravity does at the edge
// and, before any way, where the solid has turned over with a layer too thick to hang.
// An edge turns by more than 45 degrees within two thicknesses. It is in the open where the way down from it leads
// under the solid before it comes to another one, a bath or an outflow. all: of the sheet's vertices. Nothing moves
// before `from`, as what has to become warm first.
[[nodiscard]] std::optional<OverEdge> goes_over_edge(const Scene& scene, const formats::Frame& first,
                                                     const std::vector<Landing>& all, double from, double until);

} // namespace sheet
