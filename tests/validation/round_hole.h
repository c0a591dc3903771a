// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a hole in a film grows, in one dimension: what V42 compares with.
#pragma once
#include <vector>

namespace sheet::validation {

// A film of the thickness h round a hole, all at rest. What has been taken out of the hole lies in a border around it.
struct PiercedFilm {
  double thickness, first, border, outer; // h; the hole's radius, the border's width, the radius where it is held [m]
  double density, surface_tension, viscosity; // [kg/m^3, N/m, Pa s]
};

struct HoleRadius {
  double time, radius; // [s, m]
};

// The radius over time, until it is `last` or the hole has closed, of rings that are `width` wide at the start, with an
// error of the first order in that. Rings keep their volume; each has inertia within the film and stretches as a
// Newtonian sheet (stresses 2 μ (2 ε_r + ε_θ) and 2 μ (2 ε_θ + ε_r), no bending); tension works on both faces as
// surfaces of revolution, straight between the rings' middles and to a point at the hole's rim, with all of their slope
// and curvature. These are the equations of slender films of [Savva, Bush 2009] for a hole. Rings that have become
// narrow become one.
[[nodiscard]] std::vector<HoleRadius> growth_of_hole(const PiercedFilm& film, double last, double width);

// When the hole had a radius [s].
[[nodiscard]] double time_at(const std::vector<HoleRadius>& growth, double radius);

} // namespace sheet::validation
