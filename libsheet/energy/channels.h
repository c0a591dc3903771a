// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid between two walls: where another wall faces the one on which a layer lies, nearer than the layer is thick, as
// under a roller, a blade or the upper half of a mould. A layer that fills a gap g between walls that move at U1 and
// U2, with the slip lengths b1 and b2, has the mean velocity u and is dragged along them by
//   3 μ (u - U)/D,   D = g (1 + 4 s + 12 p)/(4 (1 + s)),   U = U1 + (U2 - U1) (g/2 + b1)/(g + b1 + b2),
// s = (b1 + b2)/g, p = b1 b2/g² [plane Couette and Poiseuille flow with Navier's slip; Batchelor 1967, section 4.2]: D
// = g/4 and the walls' mean velocity without slip. With b2 = infinity it is the layer with a free face (wall_drag.h).
// The second wall bears the part (g/2 + b1)/(g + b1 + b2) of that drag, the first one the rest, and besides liquid is
// sheared between the two: the second wall drags it by μ (U2 - U1)/(g + b1 + b2), and the first one by as much against
// that (the same profile's slopes at the walls).
// What lies in the gap is in its middle, and no thicker than it is wide (channel_pressure.h).
//
// What is too thick for its gap at once, as where a solid stands in the sheet at the start, gives way at ten times the
// rate at which the walls move there: the speed of closing over the gap, that of sliding over the hydraulic diameter,
// and nothing of how they part: a gate that is lifted presses nothing out. (A rate that knew of the liquid's own speed
// would feed on itself.)
//
// A layer comes to fill a gap as its face touches: from 1.1 thicknesses to 1.05, in proportion, so that forces do not
// jump.
#pragma once
#include <functional>

#include "libsheet/energy/walls.h"

namespace sheet {

inline constexpr double near_touch = 1.1; // gaps that a layer begins to fill, in its thicknesses

// What the second wall adds to a site.
struct ChannelDrag {
  double depth = 0; // D [m], infinite between two walls along which liquid slips freely
  double part = 0;  // of the way from U1 to U2 that U is, and of the drag that the second wall bears
};

// The gap [m], the slip lengths [m] of a wall and of that which faces it, each finite or free_slip.
[[nodiscard]] ChannelDrag channel_drag(double gap, double slip, double facing_slip);

// How far a layer of this thickness [m] fills a gap [m]: 1 where it touches both walls, 0 where its face is free.
[[nodiscard]] double filled_part(double thickness, double gap);

// Gives the stage's sites that lie between two walls their channels, and sets their rate. thickness: of each vertex
// [m]. carried: where a wall takes what is at a vertex, as in WallSite::carried.
void set_channels(const std::vector<Wall>& walls, std::span<const double> thickness,
                  const std::function<Vector3(const Wall&, std::uint32_t vertex)>& carried, Stage& stage);

// Of a site, or null.
[[nodiscard]] inline const Channel* channel_of(const Stage& stage, const WallSite& site) {
  return site.channel == no_index ? nullptr : &stage.channels[site.channel];
}

} // namespace sheet
