// SPDX-License-Identifier: GPL-3.0-or-later
// Remeshing of a frame: splits, collapses, flips, smoothing and repair, in this order [Batty et al. 2012, section 3.6;
// operations after Brochu, Bridson 2009, quantities by rules of our own].
#pragma once
#include "libsheet/remesh/size_field.h"

namespace sheet::remesh {

struct Options {
  SizeOptions size;
  bool smooth = false;       // move inner vertices where angles are small
  bool intersections = true; // edits may not make triangles intersect
};

struct Report {
  std::uint64_t splits = 0, collapses = 0, flips = 0, smoothed = 0, absorbed = 0, filled = 0;
  std::uint64_t sharp = 0;     // triangles left with an angle below 20 degrees
  bool budget_reached = false; // more edits were due than one call makes; the next call goes on
  [[nodiscard]] std::uint64_t edits() const { return splits + collapses + flips + smoothed + absorbed + filled; }
  // With what was done after it: edits add up; what is left is what the later one left.
  Report& operator+=(const Report& later);
};

// Works in place; the frame stays as it is, bit for bit, if its mesh needs nothing. Arrays go by their rules
// (formats/sheet.md, section 4). `scene` may be null: then nothing is known of buckling, and holds hold all axes.
// Errors: usage (options, more than 10^8 triangles), bad_input (no oriented manifold, pinched vertices).
Report remesh(formats::Frame& frame, const Scene* scene, const Options& options);

} // namespace sheet::remesh
