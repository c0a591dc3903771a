// SPDX-License-Identifier: GPL-3.0-or-later
// The plain triangle mesh that shapes and mesh files deliver, before it becomes a Sheet.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "formats/cpp/foreign_mesh.h"

namespace sheet {

using TriangleIndices = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;  // [m]
  std::vector<TriangleIndices> triangles;  // counter-clockwise seen from the positive side
  std::vector<double> vertex_thickness;    // [m], empty or one a vertex
  std::vector<double> triangle_thickness;  // [m], empty or one a triangle
  std::vector<Eigen::Vector3d> velocities; // [m/s], empty or one a vertex
  std::vector<formats::MeshArray> arrays;  // of a file, those that were asked for
};

} // namespace sheet
