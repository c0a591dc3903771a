// SPDX-License-Identifier: GPL-3.0-or-later
// How far the middle of a layer is from the wall on which it lies. Mechanics keep this distance through a step
// (walls.h); at its end, layers are put at half of what they have become, without speed. Thickness is here volume over
// area as the wall sees it, of the triangles that lie, with all their corners on the wall: moving a vertex across the
// wall does not change it, so the distance is not fed back. What stands on a wall, or hangs over its edge, has no such
// thickness, and keeps its distance. Between two walls (channels.h) a layer is
// in the middle at most.
#pragma once
#include <span>
#include <vector>

#include "libsheet/energy/walls.h"
#include "libsheet/sheet/contact_spring.h"

namespace sheet {

// Of each vertex at the end of a step: the thickness of what lies on walls [m], 0 where nothing does.
[[nodiscard]] std::vector<double> lying_thickness(const Stage& stage, const State& end);

// Moves what lies on one wall, and by contacts on what does, towards half its thickness from it, by at most a tenth of
// the mean length of its edges, along the axes only that no [[hold]] or inlet prescribes. What lies on another layer
// moves, too, by what the distance between them grows more than the step foresaw (spring_rests.h). Where thickness
// changes steeply the middle rises by no more than 0.3 of the way along the wall from what is lower beside it: over
// edges shorter than what lies there is thick, triangles would stand upright and fold, and mechanics do not see the
// distance.
void set_distances_from_walls(const std::vector<Wall>& walls, const std::vector<Hold>& holds,
                              std::span<const ContactSpring> contacts, const Vector3& gravity, const Stage& stage,
                              State& end);

} // namespace sheet
