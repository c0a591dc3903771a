// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/solidify.h"

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/shape/mesh_measure.h"
#include "libsheet/shape/regions.h"

namespace sheet {

std::vector<double> thickness_at_vertices(const TriangleMesh& mesh) {
  if (mesh.vertex_thickness.size() == mesh.positions.size())
    return mesh.vertex_thickness;
  if (mesh.triangle_thickness.size() != mesh.triangles.size())
    fail(ExitCode::bad_input, "the mesh has no thickness");
  std::vector<double> area, volume;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleIndices& t = mesh.triangles[i];
    const Eigen::Vector3d& a = mesh.positions[t[0]];
    area.push_back(0.5 * (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm());
    volume.push_back(area[i] * mesh.triangle_thickness[i]);
  }
  return thickness_around(mesh.positions.size(), mesh.triangles, volume, [&](std::uint32_t t) { return area[t]; });
}

TriangleMesh solidify(const TriangleMesh& mesh, const std::vector<double>& vertex_thickness) {
  const std::size_t n = mesh.positions.size();
  if (vertex_thickness.size() != n)
    fail(ExitCode::internal, "solidify: {} thicknesses for {} vertices", vertex_thickness.size(), n);
  const auto loops = boundary_loops(mesh); // also checks that the mesh is a manifold
  const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
  TriangleMesh solid;
  solid.positions.reserve(2 * n);
  for (const double half : {0.5, -0.5})
    for (std::size_t i = 0; i < n; ++i)
      solid.positions.emplace_back(mesh.positions[i] + half * vertex_thickness[i] * normals[i]);
  const std::uint32_t below = static_cast<std::uint32_t>(n);
  solid.triangles = mesh.triangles;
  for (const TriangleIndices& t : mesh.triangles)
    solid.triangles.push_back({below + t[0], below + t[2], below + t[1]});
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()]; // the mesh lies to the left of a -> b
      solid.triangles.push_back({b, a, below + a});
      solid.triangles.push_back({b, below + a, below + b});
    }
  return solid;
}

} // namespace sheet
