// SPDX-License-Identifier: GPL-3.0-or-later
// The end of a step made safe from the scene's solids: what touches them is held, nothing passes through them.
//
// Vertices [Batty et al. 2012, section 3.5]. A vertex whose path comes within half the sheet's thickness of a solid's
// surface sticks to it from then on: it moves with the surface, belts included, and ends at half the thickness from it.
// It keeps its touch bit until it is pulled off (release.h). A vertex without a bit that starts within half the
// thickness and moves out is left alone, so what has been released gets away. A vertex that a [[hold]] fixes along some
// axes is put and moved along the others only. A touch bit of a vertex that starts farther from its solid than the
// sheet is thick, as remeshing over a hollow makes, counts for nothing, but where it flows and sheet-step has brought
// it back to its wall.
//
// Triangles. Where a triangle's path comes within an eighth of its thickness of a solid while its corners stay clear
// (a rod or a tip through its middle, a corner of a box), the point that hits first sticks: the corners' ends are moved
// by an inelastic impulse without slip, shared as their masses ask. After some rounds of that, what still hits is
// carried with the solid from its start on. A carried triangle does not move in the solid's frame, and each further
// round carries at least one vertex more, so this ends; after it no triangle's path comes closer to a solid than an
// eighth of its thickness. One that started closer keeps nine tenths of its distance on the way and ends with all of
// it; impulses try to bring it out to a quarter. Exceptions, counted in the report: triangles that start across a
// solid's surface, those that [[hold]]s drive into one, and those between two solids that close on each other.
//
// Paths. In the frame of a solid that turns or speeds up, straight paths are bent; they are followed in pieces, as many
// as it takes to stay within a hundredth of the sheet's least thickness of the true path.
//
// The results are the same bits for any number of threads: what is found in parallel is applied in order.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libsheet/collide/step_path.h"
#include "libsheet/solid/solids.h"

namespace sheet::collide {

// Where a vertex lies between two solids.
struct BetweenSolids {
  Vector3 place = Vector3::Zero(); // of the vertex [m]
  std::size_t first = 0, second = 0;
  double gap = 0, thickness = 0; // between the two; of the sheet [m]
};

struct SolidReport {
  std::size_t touching = 0;                // vertices held by solids at the end
  std::size_t caught = 0;                  // those that were not at the start
  std::size_t pushed = 0;                  // impulses on triangles
  std::size_t carried = 0;                 // vertices carried with a solid because impulses did not help
  std::size_t started_across = 0;          // triangles that start across a solid's surface
  std::size_t brought_out = 0;             // vertices that started inside a solid, by at most half an edge
  std::size_t between = 0;                 // vertices in gaps between two solids below half the sheet's thickness
  BetweenSolids narrowest;                 // of those, where between > 0
  std::size_t unresolved = 0;              // triangles that still come too close (see above)
  Vector3 unresolved_at = Vector3::Zero(); // a corner of the last of those, where unresolved > 0

  // With what was done after it: of `touching` and `started_across` the most, all else adds up; places and the
  // narrowest are the later ones'.
  SolidReport& operator+=(const SolidReport& later);
};

// Corrects end, velocity, touch and fixed of the path; `touch` has a solid or no_solid for each vertex at the start,
// `fixed` is set there for the vertices of [[hold]]s; those fixed along all axes are left alone. Vertices of no
// triangle, whose thickness is 0, are given the least thickness. Does nothing without solids. A vertex that starts in a
// solid, by at most half of its longest edge, is caught there and ends outside. Throws Error (bad_input) where one
// starts deeper, unless a [[hold]] put it there.
SolidReport resolve_solids(StepPath& path, const solid::Solids& solids);

// The triangles that the path takes too close to a solid (as above, less a fifth so that round-off raises no alarm),
// ascending. For checks after other corrections; the vertices of [[hold]]s are followed too. Paths are straight, but in
// a solid's frame for what touches it or ends where it is carried.
[[nodiscard]] std::vector<std::uint32_t> unsafe_triangles(const StepPath& path, const solid::Solids& solids);

} // namespace sheet::collide
