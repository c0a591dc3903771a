// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a sheet become one with the layer that they lie on. SI units.
//
// A corner is ripe towards one of its faces when a contact spring there is older than the scene's [merge] after: its
// dates are those of the array contact_since, and of several springs the oldest counts. A triangle may be taken up by
// what is towards a face if all corners are ripe there, nothing holds it (solids, [[hold]]s, inlets), and it lies on
// other triangles with its whole area: those within 1.5 mean thicknesses that share no corner with it and whose normals
// are within 45 degrees of its own, seen along its normal (geometry/overlap.h). Where a sheet's rim juts out a little
// over that of what it lies on, triangles at the rim go along that lie on it with half of their area at least, if what
// is inside of them goes: their whole volume goes to what is below, inwards by a part of an edge.
//
// Which of two layers is taken up: the one that touches no solid, else the piece of the sheet with less volume, else,
// within a piece, the one that is above by gravity, else the one with the higher number. Pairs go from below upwards,
// and nothing is taken up by what is taken up itself, so a pile takes several steps. Patches of fewer than 8 triangles
// stay, no smaller pieces are left over, and what stays is no fan of triangles beside another one at a vertex.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/types.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

// A part of a triangle that lies on another one.
struct Lying {
  std::uint32_t upper, lower;        // triangles
  double part;                       // of the upper one's volume; those of one triangle sum to 1
  double gap;                        // from the middle of the part to the lower one, along its normal [m]
  Vector3 normal = Vector3::UnitZ(); // of the lower one, to the side of the upper one
};

struct MergePatches {
  std::vector<bool> taken;  // up, one a triangle
  std::vector<Lying> lying; // parts of those, in the order of the upper triangles
  double ripe = 0;          // area of all triangles with ripe corners that nothing holds [m²]
  [[nodiscard]] bool any() const { return !lying.empty(); }
};

// Precondition: the scene has a [merge] table; `mesh` is the frame's.
[[nodiscard]] MergePatches find_patches(const formats::Frame& frame, const Connectivity& mesh, const Scene& scene);

} // namespace sheet::flow
