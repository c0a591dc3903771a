// SPDX-License-Identifier: GPL-3.0-or-later
// Drops as small closed pieces of sheet, for what shows sheets, or hands them on. SI units.
#pragma once
#include "formats/cpp/stream_frame.h"

namespace sheet {

struct DropShells {
  // Where the middle of the shell lies, as part of the drop's radius R. At 3^(-1/3) a sheet that has the drop's volume
  // and area of its own reaches out to 1.04 R, nearest to R of all.
  double part = 0.6933612743506348;
  int partings = 2; // of the 20 triangles of an icosahedron, each into four
  [[nodiscard]] std::size_t triangles() const { return std::size_t{20} << (2 * partings); } // of one
};

// The frame without drops, and behind its own vertices and triangles those of the shells, in the order of the drops:
// with their volume and velocity, of their liquid, as warm as they are. The array `drop.shell` (triangle, uint8) is 1
// on them. The same frame where there are no drops.
[[nodiscard]] formats::Frame with_drop_shells(const formats::Frame& frame, const DropShells& shells = {});

} // namespace sheet
