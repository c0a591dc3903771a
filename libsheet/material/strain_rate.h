// SPDX-License-Identifier: GPL-3.0-or-later
// How fast liquid is strained: γ̇ = sqrt(2 D:D), D its rate of strain. That of an incompressible sheet stretched in its
// plane by E has E there and -tr E across, so γ̇² = 2 (tr(E²) + tr(E)²) [Batty et al. 2012, eq. (3)].
#pragma once
#include "libsheet/geometry/metric.h"

namespace sheet {

struct StrainRate {
  double squared = 0; // γ̇² [1/s²]
};

// Of a stretching E, a symmetric tensor in the sheet's plane [1/s].
[[nodiscard]] inline StrainRate strain_rate(const Matrix3& stretching) {
  const double trace = stretching.trace();
  return {2 * (stretching.squaredNorm() + trace * trace)};
}

// Of a triangle whose squared edge lengths change by `change` [m²] in `duration` [s]; `metric` raises indices:
// E = a⁻¹ change/(2 duration).
[[nodiscard]] inline StrainRate strain_rate(const RaisedMetric& metric, const Vector3& change, double duration) {
  const double trace = metric.trace.dot(change);
  return {(trace * trace - form_determinant(change) / metric.determinant) / (duration * duration)};
}

} // namespace sheet
