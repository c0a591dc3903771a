// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles of a sheet become one with the layer that they lie on. SI units.
//
// A triangle is ripe towards one of its faces when its corners have touched something there (contact_dates.h) for
// longer than the scene's [merge] after, without which that is the viscosity times the thickness over the surface
// tension: the time in which tension closes a gap of the thickness [Eggers, Lister and Stone 1999]. It may then be
// taken up by the nearest layer there (lying.h), if nothing holds it (solids, [[hold]]s, inlets), its piece of the
// sheet has a rim, and it lies on that layer with its whole area. Where a rim juts out a little over that of the layer
// below, triangles go along that lie on it with half of their area at least, or are next to what lies on it and wholly
// within 1.5 mean thicknesses of that, if nothing beyond them stays: their volume goes below, inwards by less than
// that.
//
// Which of two layers is taken up: the one that touches no solid, else the one whose piece of the sheet has less
// volume, but of two that differ by less than a tenth, and within a piece, the one that is above by gravity; else the
// one with the higher number. What is below is decided first, and nothing is taken up by what is taken up itself; of
// two pieces that lie on each other one goes and takes nothing up meanwhile, so a pile takes several steps. Patches are
// whole (whole_patches.h).
#pragma once
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/flow/lying.h"
#include "libsheet/scene/scene.h"

namespace sheet::flow {

struct MergePatches {
  std::vector<bool> taken;  // up, one a triangle
  std::vector<Lying> lying; // parts of those, in the order of the upper triangles
  double ripe = 0;          // volume of all triangles that would go if enough of them lay on what is below [m³]
  [[nodiscard]] bool any() const { return !lying.empty(); }
};

// Precondition: the scene has a [merge] table; `mesh` is the frame's.
[[nodiscard]] MergePatches find_patches(const formats::Frame& frame, const Connectivity& mesh, const Scene& scene);

} // namespace sheet::flow
