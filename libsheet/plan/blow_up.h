// SPDX-License-Identifier: GPL-3.0-or-later
// When pressure inflates a sheet to any size.
#pragma once
#include <optional>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// The time at which the scene's pressure has blown a sheet up [s]; none where no closed form is known, or the sheet
// does not blow up, as where its surface tension gamma bears the pressure. With r the radius, h the thickness and mu
// the viscosity, the volume of liquid constant, and without tension:
//   sphere, constant pressure p: dr/dt = p r²/(12 mu h), so 4 mu h/(p r); caps likewise, in about that time, with the
//   radius of the rim where that is held and they are less than a half sphere
//   sphere, p = value (reference/r)²: 12 mu h/(p r)
//   tube, constant pressure, its length kept or its ends free: 2 mu h/(p r)
//   flat sheet held at its rim, constant pressure: a cap over the circle of its half width a, evenly thick, of the area
//   A; the power of the pressure is what stretching dissipates, 3 mu ((dA/dt)/A)² in a volume, so 1.5 pi mu h/(|p| a)
// In general the rate of strain c (dr/dt)/r is that of the stress tau = (p r - m gamma)/(c h), with c = 2 sqrt(3), m =
// 4 for spheres and c = 2, m = 2 for tubes, and the time is the integral of c/rate over ln r; of a flat sheet c s/((1 +
// s²) rate) over s, its height over a, with tau = p a (1 + s²)²/(2 c h s). Where tau is below a yield stress nothing is
// blown up. With inertia sqrt(2 rho h r/(p - m gamma/r)) more, or sqrt(2 rho h a/|p|), in which it is thrown so far.
[[nodiscard]] std::optional<double> blow_up_time(const Scene& scene);

// Whether solids stand around the first frame's sheet, as a mould does, and end that: three quarters of the ways out
// from its middle through its vertices meet one. Of a flat sheet those ways fill the half space to which it bulges, and
// are half as long again as the radius of a circle of its area.
[[nodiscard]] bool is_blown_into_mould(const Scene& scene, const formats::Frame& first);

} // namespace sheet
