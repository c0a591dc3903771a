// SPDX-License-Identifier: GPL-3.0-or-later
// What floats, is held by nothing, and has no inertia may turn about the vertical as it likes. How it turns is then
// what Newton's method leaves of it: a step's correction is worked out with matrices of a sheet that is not yet turned
// so far, and turns it back too far, by six times and more from step to step. As nothing asks for any turn, there shall
// be none. The same holds of what has no weight either and touches a solid at one point, or at two, for turns about
// those.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/holds.h"
#include "libsheet/energy/model.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"

namespace sheet {

[[nodiscard]] bool turns_freely(const Model& model);

// Takes the mean turning of each connected piece about an axis through its middle away from its velocities; the axis
// has any length but zero.
void stop_turning(const Connectivity& mesh, std::span<const Vector3> positions, const Vector3& axis,
                  std::span<Vector3> velocities);

// Whether nothing but holds determines how pieces turn.
[[nodiscard]] bool turns_about_holds(const Model& model);

// Takes the mean turning of each connected piece that is held at one or two vertices about these away from its
// velocities, as seen from what holds it at the time t [s].
void stop_turning_about(const std::vector<Hold>& holds, double t, const Connectivity& mesh,
                        std::span<const Vector3> positions, std::span<Vector3> velocities);

} // namespace sheet
