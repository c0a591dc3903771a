// SPDX-License-Identifier: GPL-3.0-or-later
// How far from a solid's surface the vertices of a sheet are that touch it: where its middle is drawn, and what it
// collides with. What they are caught at is here; what becomes of it on walls in energy/wall_distance.h.
//
// Chords. A triangle on a convex surface cuts into it by the depth of its chord. Where that is more than a thin film
// leaves room for, vertices stand farther off, so that films touch by their vertices and not by their triangles.
#pragma once
#include <span>
#include <vector>

#include "libsheet/collide/solid_view.h"

namespace sheet::collide {

// Of each vertex, by how much farther than half its thickness it keeps from solids [m]: 0 unless the chord of an edge
// there, at the end of the path, is deeper than a quarter of the thickness. It grows from 0 as the edge's other end
// comes down to the solid, so that what touches does not jump then.
[[nodiscard]] std::vector<double> chord_allowances(const StepPath& path, std::span<const SolidView> views,
                                                   std::span<const double> longest_edges);

// Of each vertex at the start: its triangles' vector areas added up, over the sum of their areas.
[[nodiscard]] std::vector<Vector3> facings(const StepPath& path);

// The distance at which a vertex that is at x, in the solid's frame, comes to touch it [m]: half the thickness of what
// will lie on it or stick to it, down to half of that where a sheet that may flow stands on its rim. Farther off than
// `within` [m], that of what lies.
[[nodiscard]] double catching_distance(const StepPath& path, const SolidView& view, std::uint32_t vertex,
                                       const Vector3& x, double within);

} // namespace sheet::collide
