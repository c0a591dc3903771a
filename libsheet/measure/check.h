// SPDX-License-Identifier: GPL-3.0-or-later
// Is a frame valid? Everything that is wrong with it, also with one that StreamReader::Values::check refuses.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "formats/cpp/stream_frame.h"

namespace sheet {

struct CheckOptions {
  bool intersections = true; // look for triangles that intersect
  std::size_t examples = 5;  // places to name for each kind of problem
};

struct Finding {
  std::string_view kind;             // one word for programs: "intersection"
  std::string_view text;             // for people: "pairs of triangles that intersect"
  std::uint64_t count = 0;           // of places
  std::vector<std::string> examples; // the first places
};

// Empty if all is well. Kinds (check_report.h tells them to users), in this order; triangles that name wrong vertices
// or lie at positions that are not finite are left out of what follows them:
//   rule           a standard array is missing or breaks a rule that has no kind of its own (formats/sheet.md, section
//   5) scene          the scene cannot be read not_finite     a value is NaN or infinite, in any floating-point array
//   out_of_range   a triangle names a vertex that does not exist
//   repeated       a triangle names a vertex twice
//   volume         the volume is not positive
//   unused         a vertex belongs to no triangle
//   duplicate      two triangles have the same vertices
//   non_manifold   more than two triangles meet at an edge
//   orientation    two triangles at an edge have opposite positive sides
//   pinched        triangles meet at a vertex without being neighbours across edges
//   degenerate     a triangle's corners lie exactly on a line
//   intersection   two triangles intersect, exactly (intersections.h)
[[nodiscard]] std::vector<Finding> check(const formats::Frame& frame, const CheckOptions& options);

} // namespace sheet
