// SPDX-License-Identifier: GPL-3.0-or-later
// Drops as they are drawn: balls of liquid, each a slab that is as thick everywhere as a ray is long in it on average.
#pragma once
#include "formats/cpp/stream_frame.h"
#include "libsheet/render/middle.h"
#include "libsheet/render/surface.h"

namespace sheet::render {

// The frame with its drops behind the sheet's triangles, as balls (sheet/drop_shells.h).
[[nodiscard]] formats::Frame with_balls(const formats::Frame& frame);

// How many of its vertices and triangles are the sheet's own.
struct OwnParts {
  std::size_t vertices, triangles;
};
[[nodiscard]] OwnParts own_parts(const formats::Frame& with_balls);
// The middle surface of these.
[[nodiscard]] Middle own_middle(const formats::Frame& with_balls);

// Adds the balls to the surface of the sheet.
void add_balls(const formats::Frame& with_balls, Surface& surface);

} // namespace sheet::render
