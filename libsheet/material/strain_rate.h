// SPDX-License-Identifier: GPL-3.0-or-later
// How fast liquid is strained: γ̇ = sqrt(2 D:D), D its rate of strain. That of an incompressible sheet stretched in its
// plane by E has E there and -tr E across, so γ̇² = 2 (tr(E²) + tr(E)²) [Batty et al. 2012, eq. (3)].
#pragma once
#include <array>

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

// Of a triangle whose corners are at x [m] and move at v [m/s].
[[nodiscard]] inline StrainRate strain_rate(const std::array<Vector3, 3>& x, const std::array<Vector3, 3>& v) {
  const auto grows = [&](int a, int b) { return (x[b] - x[a]).dot(v[b] - v[a]); };
  return strain_rate(RaisedMetric(squared_lengths(x[0], x[1], x[2])),
                     2 * Vector3(grows(1, 2), grows(2, 0), grows(0, 1)), 1);
}

} // namespace sheet
