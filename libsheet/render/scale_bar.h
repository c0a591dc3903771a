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
[[nodiscard]] Ruler make_ruler(const Scale& scale, const Field& field, int most);

// Whether a picture of that size has room for scale and time: a scale without numbers says nothing.
[[nodiscard]] bool has_room_for_scale(int width, int height);
// The parts of a picture's width and height that the scale and the time take away at the right and at the bottom.
[[nodiscard]] double scale_width(int width, int height);
[[nodiscard]] double clock_height(int width, int height);

// Draws the bar at the right edge, and "t = 0.25 s", or years, at the lower left, where there is room. Nothing for
// looks without a scale but the time.
void draw_scale(Bitmap& bitmap, const Scale& scale, Look look, double time);

} // namespace sheet::render
