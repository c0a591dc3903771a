// SPDX-License-Identifier: GPL-3.0-or-later
// The velocity rule of every edit. The vertices around an edit carry the masses m (a third of each triangle's) and the
// velocities u; the edit changes masses and interpolates u. Then momentum is restored, u += Δp / M, and where the
// kinetic energy has grown, the velocities are drawn together about their mean until it is what it was. (Interpolation
// alone loses momentum in flips and collapses and raises the energy in a quarter of them.)
#pragma once
#include <array>
#include <span>

#include "libsheet/geometry/axes.h"
#include "libsheet/geometry/types.h"

namespace sheet::remesh {

struct Flow {
  Vector3 momentum = Vector3::Zero(); // per density [m³ m/s]
  double energy = 0;                  // likewise [m³ m²/s²]
  void add(double volume, const Vector3& u) {
    momentum += volume * u;
    energy += 0.5 * volume * u.squaredNorm();
  }
};

struct MovingVertex {
  double volume;     // that the vertex carries after the edit [m³]
  Vector3* velocity; // [m/s]
  Axes held;         // these components of its velocity are prescribed and stay
};

// Makes the vertices' momentum that of `before`, and their energy at most that of `before` (with held vertices among
// them as far as the others can). Nothing happens if all are held.
void restore_flow(const Flow& before, std::span<const MovingVertex> vertices);

} // namespace sheet::remesh
