// SPDX-License-Identifier: GPL-3.0-or-later
// On which face a bath reaches a sheet, where it has come over it, and where another layer is in between. SI units.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/bath_surface.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

struct FloatingSheet {
  const Connectivity& mesh;
  std::span<const Vector3> positions;
  std::span<const double> volumes;         // of the triangles [m³]
  std::span<const ContactSpring> contacts; // between its layers
  std::vector<char> shut;                  // of each vertex, whether nothing comes over it if it is on a rim
};

// How the bath reaches each vertex; empty: from below all of them. up: against gravity; level: of the bath along that.
//
// Facing: of a connected piece that lies on its face, all in all. Outside: of one that is closed, or nearly so, with
// its normals outwards.
//
// Around: what floats sinks until it displaces its own weight, with |d| < h if it is lighter than the bath, d the
// height of a vertex above the level and h the thickness there. Where d + h < 0, with h that of all that lies on it,
// the bath stands above it, and is there if it has come over a rim: a vertex is flooded that is on a rim, or next to
// one that is flooded, each of them as deep. A rim that lies on another layer is open if that is flooded. So a boat
// stays dry whose rims are above the level. At d = -h the lift of both faces, ρ g V, is that of the lower one alone.
//
// None: a vertex is borne where a contact spring says that it lies on a triangle, no farther aside than over it, and
// that one lies as its piece does, so that the bath bears it with all that is above, or is borne itself. What lies on a
// layer that the bath is around, or that lies the other way, is not: that one is wet on both faces.
[[nodiscard]] std::vector<BathReach> bath_reach(const FloatingSheet& sheet, const Vector3& up, double level);

} // namespace sheet
