// SPDX-License-Identifier: GPL-3.0-or-later
// With what velocity liquid flows in at an inlet: u(t) + w(t) e(x), u the same for all of the inlet, w away from the
// axis of the sheet, through its center along its plane's normal, e the unit vector out of that axis to x; on the axis
// itself e = 0.
#pragma once
#include <vector>

#include "libsheet/scene/scene.h"

namespace sheet::scene {

struct InletVelocity {
  Timed<Vector3d> common; // u [m/s]
  Timed<double> radial;   // w [m/s]; without entries all flows in alike
  SheetAxis axis;

  [[nodiscard]] bool fans_out() const { return !radial.entries.empty(); }
  [[nodiscard]] Vector3d at(double t, const Vector3d& x) const;
  // Of what flows in at x, from one time to another [m].
  [[nodiscard]] Vector3d way(double from, double to, const Vector3d& x) const;
  // The root of the mean square around a ring about the axis [m/s].
  [[nodiscard]] double speed(double t) const;
  // The times of all rows [s], increasing: between them it is linear.
  [[nodiscard]] std::vector<double> times() const;
};

// `inflow` is one of the scene's.
[[nodiscard]] InletVelocity inlet_velocity(const Scene& scene, const Inflow& inflow);

} // namespace sheet::scene
