// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles between rows and rings of vertices.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

// A grid of (columns + 1) x (rows + 1) vertices, or columns x (rows + 1) if it closes around; vertex (i, j) has the
// index j * (vertices a row) + i. Squares are cut by diagonals of alternating direction. Triangles are
// counter-clockwise if rows follow each other to the left of the direction of a row.
[[nodiscard]] std::vector<TriangleIndices> grid_triangles(std::uint32_t columns, std::uint32_t rows, bool closed);

// A closed row of vertices, in order around.
struct Ring {
  std::uint32_t first = 0, count = 0;
};

// Appends the triangles between an inner and an outer ring that both start at about the same angle; each time the
// shorter diagonal is taken. Counter-clockwise if the rings are and the outer one surrounds the inner one.
void stitch_rings(const std::vector<Eigen::Vector3d>& positions, Ring inner, Ring outer,
                  std::vector<TriangleIndices>& triangles);

// Appends the fan between one vertex and the ring around it.
void fan(std::uint32_t center, Ring ring, std::vector<TriangleIndices>& triangles);

} // namespace sheet
