// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a sheet of liquid as it is drawn: both sides of the mid-surface at half the thickness, closed along
// the rim by a half-round bead. The bead stands out by half the thickness; a true rim of the same volume would stand
// out less.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/render/camera.h"
#include "libsheet/render/middle.h"

namespace sheet::render {

struct Surface {
  std::vector<Vector3> positions;           // [m]
  std::vector<Vec> normals;                 // outwards, smooth
  std::vector<std::uint32_t> source_vertex; // of the sheet, for each position
  std::vector<Corners> triangles;           // counter-clockwise from outside
  std::vector<std::uint32_t> source_triangle;
  std::vector<bool> on_bead;          // for each triangle
  std::vector<std::uint32_t> liquids; // number of each triangle's; empty: all are one
  bool closed = true; // false: the mid-surface alone, because the sheet is too thin to have two sides in the arithmetic
  std::vector<float> thickness; // of the sheet's vertices [m]: all volume around it / all area around it

  [[nodiscard]] std::uint32_t liquid(std::size_t triangle) const { return liquids.empty() ? 0 : liquids[triangle]; }
};

// The sheet counts as too thin below `thinnest` [m], by its mean.
[[nodiscard]] Surface make_surface(const Middle& middle, double thinnest);

} // namespace sheet::render
