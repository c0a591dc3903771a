// SPDX-License-Identifier: GPL-3.0-or-later
// The local operations as edits. Each fills an edit, or returns false where the operation is not possible: connectivity
// would break, a held border or a corner would be touched. Whether the edit is good is for EditableSheet::make to say.
#pragma once
#include "libsheet/remesh/editable_sheet.h"

namespace sheet::remesh {

// Cosine of the angle by which a rim may turn at a vertex that may go; beyond, it is a corner.
inline constexpr double corner_cosine = 0.70710678118654752; // 45 degrees

// The rim's neighbours of a rim vertex: where the rim comes from and where it goes to (the sheet on its left).
struct RimNeighbours {
  std::uint32_t before, after;
};
[[nodiscard]] RimNeighbours rim_neighbours(const Mesh& mesh, std::uint32_t v);

// True for a rim vertex at which the rim turns by more than 45 degrees.
[[nodiscard]] bool is_corner(const EditableSheet& sheet, std::uint32_t v);

// Six times the volume between a patch of triangles and a point.
[[nodiscard]] double cone_volume(const EditableSheet& sheet, std::span<const std::uint32_t> triangles,
                                 const Vector3& tip);

// The edge of `side` gets a vertex in its middle; children keep their parent's thickness.
void propose_split(const EditableSheet& sheet, std::uint32_t side, Edit& edit);

// The edge becomes the other diagonal of its two triangles. False on a rim, where the diagonal exists elsewhere,
// between two vertices that are held alike.
[[nodiscard]] bool propose_flip(const EditableSheet& sheet, std::uint32_t side, Edit& edit);

// The edge becomes a point. Within the sheet, where it is nearest to the planes of the triangles around [Garland,
// Heckbert 1997] and sweeps no volume (but what the vertices' ledgers owe, up to `pay` metres of movement); on a rim,
// where the rim's area stays [Lindstrom, Turk 1998]; an inner vertex goes to the rim's, a free one to the held one.
// False where the result would be no manifold [Dey et al. 1999], between rims, between vertices that are held
// differently, at corners. `onto`: an end whose place it becomes instead; false if the other one insists on its own.
[[nodiscard]] bool propose_collapse(const EditableSheet& sheet, std::uint32_t side, double pay, Edit& edit,
                                    std::uint32_t onto = no_index);

// An inner vertex of three triangles goes, and one triangle takes their place: a pocket whose rim is a triangle, which
// no other operation can open or close. What liquid it has more than that triangle takes goes to the neighbours, too.
// False where the triangle exists already or a vertex of the rim would be left with too few, or if the vertex is held
// by more than a solid that it touches and none of the rim's is held as it is.
[[nodiscard]] bool propose_removal(const EditableSheet& sheet, std::uint32_t v, Edit& edit);

// A free inner vertex moves along the sheet to the middle of its triangles, weighted by their areas. The movement
// sweeps no volume, but what the ledger owes, up to `pay`.
[[nodiscard]] bool propose_smooth(const EditableSheet& sheet, std::uint32_t v, double pay, Edit& edit);

// The triangle of a rim side goes and its apex, an inner vertex, moves onto the side: cures triangles that are flat
// towards the rim.
[[nodiscard]] bool propose_absorb(const EditableSheet& sheet, std::uint32_t rim_side, Edit& edit);

// A triangle at the rim goes, with its tip if two of its sides are the rim's; its liquid goes to its neighbours, which
// stay as they are. False where it has no neighbour or no rim, where the sheet would be left to hang by a vertex, or a
// corner is held by more than a solid that it touches.
[[nodiscard]] bool propose_trim(const EditableSheet& sheet, std::uint32_t triangle, Edit& edit);

// A notch in the rim on a wall gets a triangle, between a rim vertex and its two neighbours on the rim; its liquid
// comes from the triangles around that vertex, which stay as they are. False where the two are neighbours already,
// where not all three flow along the same wall and touch nothing else (a tooth of a comb, a post that stands in it), or
// where the two do not come nearer to each other and none is the end of an inlet's strip.
[[nodiscard]] bool propose_fill(const EditableSheet& sheet, std::uint32_t v, Edit& edit);

} // namespace sheet::remesh
