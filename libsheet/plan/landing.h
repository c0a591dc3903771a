// SPDX-License-Identifier: GPL-3.0-or-later
// Where what falls would land: the first solid straight below it.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet {

struct Landing {
  std::size_t solid;       // its number in the scene
  double fall;             // the way down to it [m]
  Vector3 place;           // at the way's end [m]
  solid::SolidPoint there; // of the solid, at the first frame's time
  Liquid liquid = {};      // of what falls
  std::size_t vertex = 0;  // that falls
};

// About a hundred of its vertices, spread over it.
[[nodiscard]] std::vector<std::size_t> probes_of(const formats::Frame& first);

// Of the probes those that are above a solid; none without gravity.
[[nodiscard]] std::vector<Landing> landings(const Scene& scene, const formats::Frame& first);

// Of what is at x at the time t [s] and falls down (a unit vector), over a sheet of that size [m].
[[nodiscard]] std::optional<Landing> landing_below(const solid::Solids& solids, const Vector3& down, const Vector3& x,
                                                   double size, double t);

// The longest of their falls [m]; 0 if there is none.
[[nodiscard]] double longest_fall(const std::vector<Landing>& landings);

// In which the longest of them lands [s], 0 if there is none: from rest, but of what starts downward faster than it
// would come to land so, with the speed of the scene's slowest sheet.
[[nodiscard]] double fall_time(const Scene& scene, const std::vector<Landing>& landings);

// The shortest fall of what stands at the inlet of that inflow; nothing if it is above no solid, or without gravity.
[[nodiscard]] std::optional<Landing> landing_of_inflow(const Scene& scene, const formats::Frame& first,
                                                       std::size_t number);

// The greatest flux of what flows in until that time [s] at least, and lands on that solid, for each metre across its
// way [m²/s].
[[nodiscard]] double flux_onto(const Scene& scene, const formats::Frame& first, std::size_t solid, double until);

// Of what stands there above no solid the longest fall, each to the first outflow below it [m]; 0 if there is none.
[[nodiscard]] double fall_to_outflow(const Scene& scene, const formats::Frame& first, std::size_t number);

// Of what begins that fall with the speed v0 [m/s], at its end: the least of sqrt(v0² + 2 g H) (free fall) and
// v0 + rho g H²/(8 mu) (a viscous curtain's first stretching, whose force at y is rho g (H - y) h and equals
// 4 mu h dv/dy [Trouton 1906; Brown 1961, J. Fluid Mech. 10]).
[[nodiscard]] double speed_after_fall(const Scene& scene, double v0, const Landing& landing);

} // namespace sheet
