// SPDX-License-Identifier: GPL-3.0-or-later
// Holes that open where inclusions pierce a sheet (exposure.h). A hole is made of the triangles around the vertex that
// is nearest to the site; more of them, the nearest first, until its area is that of a circle of half the thickness, as
// smaller holes close [Taylor and Michael 1973]. Where edges are longer than the sheet is thick it is as large as these
// triangles, so ahead of its time by its radius over the speed at which it grows. From then on tension draws it open.
//
// Its liquid goes to the triangles around it, by their areas, with its momentum (deposit.h): volume and momentum stay,
// kinetic energy falls by that of the relative motion, the exposure of what was pierced stays with the liquid.
//
// A hole keeps one row of triangles clear of rims, of other holes that open in the same step, and of vertices that are
// supported. A site that has no room within two edges is in a strip, or beside a rim: it opens no hole, and what it
// pierces is to part as thin edges do (tear_cuts.h), across the strip or into the rim.
#pragma once
#include <span>
#include <vector>

#include "libsheet/flow/exposure.h"

namespace sheet::flow {

struct Holes {
  std::size_t opened = 0;
  std::size_t without_room = 0; // sites that opened none
  // Triangles around the vertex nearest to each of these, by their numbers in the frame afterwards; as they come.
  std::vector<std::uint32_t> pierced;
};

// Opens them, in the order of the sites. The frame is the same, bit for bit, if none opens. supported: vertices that
// are held, touch a solid or another layer, or belong to an inlet; these neither go nor receive anything.
Holes open_holes(formats::Frame& frame, std::span<const Site> sites, const std::vector<bool>& supported);

} // namespace sheet::flow
