// SPDX-License-Identifier: GPL-3.0-or-later
// The outer surface of the liquid: the mid-surface moved by half the thickness both ways, joined along the rims.
#pragma once
#include <cstdint>
#include <vector>

#include "libsheet/shape/triangle_mesh.h"

namespace sheet {

// The thickness at the vertices [m]: that of the mesh, or the mean of the triangles around weighted by area. Throws
// Error (bad_input) if the mesh has no thickness.
[[nodiscard]] std::vector<double> thickness_at_vertices(const TriangleMesh& mesh);

// A closed mesh facing outward. Vertex i of n becomes i (x + h/2 normal) and n + i (x - h/2 normal). A closed
// mid-surface gives two closed surfaces, the inner one facing inward. The enclosed volume is that of the sheet up to
// the square of thickness times curvature. Where the thickness exceeds the radius of curvature or a fold, the surface
// may cross itself. Triangle i of m becomes i and m + i; `origin`, if given, says of each triangle from which of the
// mesh's it comes, those of the rim from the one beside them. Throws Error (bad_input) unless the mesh is an oriented
// manifold.
[[nodiscard]] TriangleMesh solidify(const TriangleMesh& mesh, const std::vector<double>& vertex_thickness,
                                    std::vector<std::uint32_t>* origin = nullptr);

} // namespace sheet
