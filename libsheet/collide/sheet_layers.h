// SPDX-License-Identifier: GPL-3.0-or-later
// Whether what is near in space is one layer of the sheet or two.
//
// A layer of thickness h bends to a radius of h/2 at most, where its inner face has none left. Of all curves with this
// bound on their curvature the half circle has the nearest ends, at the distance h [Schur's theorem: Chern 1967]: two
// points of one layer that are nearer than d <= h to each other are at most h asin(d/h) <= π/2 d apart along it,
// whether it is flat, shortened in its plane or bent. What is farther along the sheet, or on another piece of it, is
// another layer: the legs of a fold are, from where they leave the tightest bend.
//
// A contact counts until its features are π/3 d apart, an arc of radius d whose chord is d, so that one beside a bend
// does not come and go.
#pragma once
#include <numbers>
#include <span>

#include "libsheet/geometry/distance_along.h"

namespace sheet::collide {

class SheetLayers {
public:
  static constexpr double of_new = std::numbers::pi / 2, of_kept = std::numbers::pi / 3;

  // `mesh` must outlive it.
  explicit SheetLayers(const Connectivity& mesh) : along_(mesh) {}

  // True if the closest points of two features, a vertex and a triangle or two edges with weights as of ContactSpring,
  // are at most `part` times their contact distance [m] apart along the sheet.
  [[nodiscard]] bool one(std::span<const Vector3> positions, std::span<const std::uint32_t, 4> vertices,
                         std::span<const double, 4> weights, double part, double contact_distance) const;

private:
  DistanceAlong along_;
};

} // namespace sheet::collide
