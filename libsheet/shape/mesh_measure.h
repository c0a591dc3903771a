// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a triangle mesh: counts, lengths, angles, area, enclosed volume.
#pragma once
#include <vector>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

struct MeshFigures {
  std::size_t vertices = 0, edges = 0, triangles = 0;
  std::size_t boundary_edges = 0; // edges of one triangle
  std::size_t bad_edges = 0;      // edges of more than two triangles, or of two that run through them the same way
  double edge_min = 0.0, edge_mean = 0.0, edge_max = 0.0; // [m]
  double angle_min = 0.0, angle_max = 0.0;                // [rad]
  double area = 0.0;                                      // [m²]
  // [m³] Signed volume between the triangles and the origin: the enclosed volume of a closed mesh, positive if its
  // triangles face outward.
  double volume = 0.0;

  // Vertices - edges + triangles: 2 for a sphere, 1 for a disk, 0 for an annulus or a tube.
  [[nodiscard]] long euler_characteristic() const {
    return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(triangles);
  }
};

[[nodiscard]] MeshFigures measure(const TriangleMesh& mesh);

// An undirected edge, lower vertex first, with the number of triangles that run along it up (a to b) and down.
struct MeshEdge {
  std::uint32_t a = 0, b = 0;
  std::uint32_t up = 0, down = 0;
};

// All edges, sorted by (a, b).
[[nodiscard]] std::vector<MeshEdge> mesh_edges(const std::vector<TriangleIndices>& triangles);

// Unit normals at the vertices: triangle normals weighted by the angle at the vertex [Thürmer, Wüthrich 1998]; zero at
// a vertex without triangles.
[[nodiscard]] std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh);

// The smallest angle of one triangle [rad]; 0 if it has no area.
[[nodiscard]] double smallest_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

} // namespace sheet
