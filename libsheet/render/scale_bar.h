// SPDX-License-Identifier: GPL-3.0-or-later
// What the colours of a diagnostic picture mean: a bar with ticks, quantity and unit, and the time.
#pragma once
#include <string>
#include <vector>

#include "libsheet/render/looks.h"

namespace sheet::render {

struct Tick {
  double place; // on the bar, 0 to 1
  std::string label;
};
struct Ruler {
  std::string title; // "thickness [mm]"
  std::vector<Tick> ticks;
};

// Round values between the ends of the scale, at most about `most` of them, in the unit of the SI that suits.
[[nodiscard]] Ruler make_ruler(const Scale& scale, Look look, int most);

// Draws the bar at the right edge, and "t = 0.25 s" at the lower left. Nothing for looks without a scale but the time.
void draw_scale(Bitmap& bitmap, const Scale& scale, Look look, double time);

} // namespace sheet::render
