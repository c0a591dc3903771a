// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays at place edge on their way through a change of the mesh. A new edge's parent is the old edge whose middle is
// nearest to its own; an old edge's amount (rule conserve) goes in equal parts to the new edges whose parent it is, or,
// if there are none, to the nearest new edge.
#pragma once
#include <vector>

#include "libsheet/sheet/sheet.h"

namespace sheet {

class EdgeRows {
public:
  // Takes note of the frame's edges; costs nothing where it has no arrays at them.
  explicit EdgeRows(const formats::Frame& frame);
  // Puts the arrays into a frame with final positions and triangles, those with the rule drop excepted.
  void put(formats::Frame& frame) const;

private:
  std::vector<Eigen::Vector3d> middles_;
  std::vector<formats::Array> arrays_;
};

} // namespace sheet
