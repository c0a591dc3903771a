// SPDX-License-Identifier: GPL-3.0-or-later
// Prescribed motions for tests.
#pragma once
#include "libsheet/energy/holds.h"

namespace sheet::test {

// What is held turns about the origin, right-handed about `spin` at its length [rad/s], and moves at `velocity` [m/s].
inline void move_steadily(Hold& hold, const Vector3& spin, const Vector3& velocity = Vector3::Zero()) {
  hold.motion = [=](double from, double to) {
    RigidMotion r;
    r.rotation = Eigen::AngleAxisd(spin.norm() * (to - from), spin.stableNormalized()).toRotationMatrix();
    r.shift = velocity * (to - from);
    return r;
  };
  hold.velocity = [=](double, const Vector3& x) -> Vector3 { return spin.cross(x) + velocity; };
}

} // namespace sheet::test
