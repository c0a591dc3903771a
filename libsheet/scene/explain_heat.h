// SPDX-License-Identifier: GPL-3.0-or-later
// What temperatures mean for a scene (sheet-init --check).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "libsheet/scene/explain.h"
#include "libsheet/scene/scales.h"

namespace sheet::scene {

// The scene with the liquid that it is at the start's temperature, by whose numbers it is judged; itself without heat.
[[nodiscard]] Scene as_it_starts(const Scene& scene);

// A sheet that becomes softer, as what is around is warmer than its start.
struct Warming {
  Scene warm;  // with the liquid that it is at the temperature of the warmest around
  double time; // in which it comes near to that, counted from 0 [s]
};
// By 3 times the slowest of its times of warming (heat_scales), from when what is around is warmest; none where nothing
// warms it, or viscosity does not depend on temperature. `thickness` [m].
[[nodiscard]] std::optional<Warming> warming_of(const Scene& scene, double thickness);

// In which a sheet that cools everywhere sets, so that nothing flows any more: to a thousand times its viscosity, as
// its temperature goes from the start's to what is around by exp(-t/time), time rho c h/H of both faces, H in the mean
// over that way; it takes no longer where solids cool it, too. None where anything warms it, the faces' surroundings
// change over time or place, sheets or liquid come in later, or it does not set by that. `thickness` [m].
[[nodiscard]] std::optional<double> setting_time(const Scene& scene, double thickness);

// The times of all rows of temperatures, and of what transfers heat [s].
[[nodiscard]] std::vector<double> heat_events(const Scene& scene);

// The factor, 1 or more, by which the viscosity of a liquid of a scene with heat has changed at most at the time
// `until` [s], where all that is around brings its temperature to its own by exp(-t/time), time in s.
[[nodiscard]] double change_of_viscosity(const Scene& scene, double time, double until);

// Of scenes with heat, else none. `scales`: those of the scene as it starts.
[[nodiscard]] std::vector<Scale> heat_scales(const Scene& scene, const Scales& scales);
[[nodiscard]] std::vector<DimensionlessNumber> heat_numbers(const Scene& scene, const Scales& scales);
// Of faces that cool, or are cooled or heated by solids, long before the middle, though the profile across the
// thickness is a parabola.
[[nodiscard]] std::optional<std::string> warning_of_biot(const Scene& scene, const Scales& scales);
// Of a law that makes a viscous liquid thinner than water at the warmest that is around.
[[nodiscard]] std::optional<std::string> warning_of_thinning(const Scene& scene);

// How the viscosity goes with temperature, and what the faces do: for the list of what is modelled.
[[nodiscard]] std::string heat_in_words(const Scene& scene);

} // namespace sheet::scene
