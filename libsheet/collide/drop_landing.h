// SPDX-License-Identifier: GPL-3.0-or-later
// Where drops (sheet/drops.h) land: on solids, where they stay as balls and go where the solid and its belt take them,
// on a bath, where they rest if no sheet floats there, and on the sheet, which takes them up. SI units.
//
// A drop meets a triangle when its middle comes as near to it as its radius and half of the sheet's thickness, on
// straight ways in the step (swept_pair.h: none is missed). What starts nearer, as a drop that has just come off does,
// meets it when it comes twice as near. Liquid and momentum go to that triangle and those around it that hang together
// and whose middles are within the drop's radius of the place, by their areas: a triangle of the area A takes the
// volume dV = V A/ΣA, its corners a third of its mass each, with the drop's velocity. Volume and momentum stay to
// round-off; kinetic energy falls by that of the relative motion. Positions stay, so nothing comes to cross: the centre
// of mass moves by at most the distance of the two middles. What of momentum goes to held vertices is their hold's.
// A sheet of another liquid stops a drop and takes none of it, as layers of two liquids stay two: it lies there as a
// ball, and what momentum it loses the corners of the triangle get, by their weights at the place.
#pragma once
#include <cstddef>

#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"
#include "libsheet/solid/solids.h"

namespace sheet::collide {

struct Landed {
  std::size_t on_solids = 0, on_sheet = 0; // the bath is a solid here
  double volume = 0;                       // taken up by the sheet [m³]
  Landed& operator+=(const Landed& later);
};

// Of a frame behind a step, whose sheet is where it ends. solids: null for none. Nothing in frames without drops, or
// that do not say where these started.
Landed land_drops(formats::Frame& frame, const Scene& scene, const solid::Solids* solids);

} // namespace sheet::collide
