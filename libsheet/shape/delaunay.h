// SPDX-License-Identifier: GPL-3.0-or-later
// Delaunay triangulations of points in the plane, on a sphere and on a cylinder (by CGAL, with exact predicates).
// Triangles are in a canonical order (each starts with its smallest index, then sorted), so nothing depends on CGAL's.
#pragma once
#include <cstddef>
#include <vector>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

// Counter-clockwise seen from +z; z is not used. The boundary is the convex hull.
[[nodiscard]] std::vector<TriangleIndices> planar_delaunay(const std::vector<Eigen::Vector3d>& points);

// The convex hull of points on a sphere around the origin, facing outward; the first point must be on the +z axis and
// the only one there.
[[nodiscard]] std::vector<TriangleIndices> sphere_delaunay(const std::vector<Eigen::Vector3d>& points);

// Delaunay on a sphere around the origin, none of the points at its -z end; the boundary is what is the convex hull
// seen from there (stereographic projection). Faces outward.
[[nodiscard]] std::vector<TriangleIndices> cap_delaunay(const std::vector<Eigen::Vector3d>& points);

// Delaunay on the unrolled cylinder around the z axis. The edges must be short against the radius. Faces outward.
[[nodiscard]] std::vector<TriangleIndices> tube_delaunay(const std::vector<Eigen::Vector3d>& points, double radius,
                                                         double edge_length);

// Drops the triangles that lie in a hole whose rim is made of the points [0, rim): those with all corners there.
void drop_hole(std::vector<TriangleIndices>& triangles, std::size_t rim);

} // namespace sheet
