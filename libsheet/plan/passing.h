// SPDX-License-Identifier: GPL-3.0-or-later
// Solids that move on for ever: a paddle drawn through a layer, a ball through a curtain, a fork lifted out of syrup, a
// plate that turns. There is something to see until they have come through, or round. Likewise holds that draw a sheet
// or turn it, belts that carry it, and slopes that it runs down.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/scene/scene.h"

namespace sheet {

// When the last of those that do not turn on the spot has left the box around the sheet as it lies at the start and all
// that it falls through (what flows in and lands on nothing: down to the lowest solid), and has gone at least as far as
// the second of the box's sides is long [s]; 0 if none comes through.
[[nodiscard]] double coming_through_time(const Scene& scene, const formats::Frame& first);

// The same, and when the last that turns on the spot has turned once, if it comes to the box in that turn or liquid
// flows in, which may come to it [s]; 0 if there is none.
[[nodiscard]] double passing_time(const Scene& scene, const formats::Frame& first);

// When what lies at the start on a belt that rests, or falls on it, has been carried past the last of the solids that
// rest in its way or turn there on the spot, a blade, a roller, a second belt, and to the last outflow [s]; 0 if there
// is none.
[[nodiscard]] double carrying_time(const Scene& scene, const formats::Frame& first);

// When what flows in, and runs down a slope where it lands, has come past the last of the solids that stay in its way,
// a wall with a gate, blocks, a roller, into the bath, to the last outflow and to the slope's end [s]; 0 if there is
// none. As wide as its
// inlet it is a layer of h³ = 3 ν q/g_t, whose front goes at q/h [Nusselt 1916]; when all has flowed in, A = q t_end,
// it comes to x at 4 ν x³/(9 A² g_t) [Huppert 1982]. Likewise, without heat, of a sheet that lies on a slope from the
// start, or falls on it: by its front, which has gone so far, and not of what stands on its way, as it yields.
[[nodiscard]] double running_time(const Scene& scene, const formats::Frame& first);

// When holds that move on for ever, away from others, none of them a roll, have gone as far as the sheet is long that
// way, so that it is twice as long [s]; 0 if none does.
[[nodiscard]] double drawing_time(const Scene& scene, const formats::Frame& first);

// When the last of the holds that turn on for ever has turned once [s]; 0 if none does.
[[nodiscard]] double turning_time(const Scene& scene, const formats::Frame& first);

} // namespace sheet
