// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/solidify.h"

#include <array>
#include <map>

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

namespace {

// The triangle to the left of each side a -> b of a rim.
std::map<std::array<std::uint32_t, 2>, std::uint32_t> triangles_of_sides(const TriangleMesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      triangles[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = t;
  return triangles;
}

} // namespace

TriangleMesh solidify(const TriangleMesh& mesh, const std::vector<double>& vertex_thickness,
                      std::vector<std::uint32_t>* origin) {
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
  if (origin) {
    const auto m = static_cast<std::uint32_t>(mesh.triangles.size());
    for (std::uint32_t t = 0; t < 2 * m; ++t)
      origin->push_back(t % m);
    const auto beside = triangles_of_sides(mesh);
    for (const auto& loop : loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        origin->insert(origin->end(), 2, beside.at({loop[i], loop[(i + 1) % loop.size()]}));
  }
  return solid;
}

} // namespace sheet
