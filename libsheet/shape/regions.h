// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of vertices by place: rims, sides of the bounding box, box, sphere. For holds.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

using VertexSet = std::vector<std::uint32_t>; // sorted, each once

// The boundary, loop by loop: vertices in the order in which the mesh lies to the left. Throws Error (bad_input) where
// the mesh is not a manifold with consistent orientation.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> boundary_loops(const TriangleMesh& mesh);

[[nodiscard]] VertexSet rim(const TriangleMesh& mesh); // all boundary vertices
// The shortest and the longest boundary loop. Throw Error (bad_input) if there is no second loop, or none that differs.
[[nodiscard]] VertexSet inner_rim(const TriangleMesh& mesh);
[[nodiscard]] VertexSet outer_rim(const TriangleMesh& mesh);

// Vertices whose coordinate (0, 1, 2) is the smallest (or largest) one up to `tolerance` times the diagonal of the
// bounding box.
[[nodiscard]] VertexSet side(const TriangleMesh& mesh, int axis, bool largest, double tolerance = 1e-6);

// Vertices in the closed box [m].
[[nodiscard]] VertexSet in_box(const TriangleMesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Vertices in the closed ball [m].
[[nodiscard]] VertexSet in_sphere(const TriangleMesh& mesh, const Eigen::Vector3d& center, double radius);

// A region by its name in a scene: rim, inner_rim, outer_rim, x_min, x_max, y_min, y_max, z_min, z_max. Throws Error
// (bad_input) for other names and for the rims of a closed mesh.
[[nodiscard]] VertexSet named_region(const TriangleMesh& mesh, std::string_view name);

} // namespace sheet
