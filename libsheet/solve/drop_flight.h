// SPDX-License-Identifier: GPL-3.0-or-later
// Drops between two meetings: parabolas, which are exact whatever the steps, or, where the scene has air, what its drag
// on a ball makes of them,
//   dv/dt = g - 3 C ρ_a |w| w/(8 ρ r),   w = v - wind,
// with C = 0.44 [Newton's range, Reynolds numbers of 1e3 to 1e5; below, drag is more], the wind that of the middle of
// the step, by steps of the fourth order [Kutta 1901] as short as they need be for a millionth. A drop that lies on a
// solid is where the solid takes it (collide/drop_landing.h). SI units.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// What works on a drop that flies.
struct DropForces {
  Vector3 gravity = Vector3::Zero(); // [m/s²]
  Vector3 wind = Vector3::Zero();    // [m/s]
  double drag = 0;                   // 3 C ρ_a/(8 ρ) [1]; 0: no air
};

// After the time `duration` [s]; radius [m].
struct DropMotion {
  Vector3 position, velocity; // [m], [m/s]
};
[[nodiscard]] DropMotion flown(const DropMotion& start, double radius, double duration, const DropForces& forces);

// Moves the frame's drops from the time `start` [s] to the frame's, and notes where they were (drop_start_position).
// Nothing in frames without.
void fly_drops(formats::Frame& frame, const Scene& scene, double start);

} // namespace sheet
