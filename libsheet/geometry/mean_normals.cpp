// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/mean_normals.h"

#include "libsheet/base/each.h"
#include "libsheet/geometry/angles.h"
#include "libsheet/geometry/area.h"

namespace sheet {

namespace {

constexpr double cancelled = 1e-8; // length of a sum of two unit vectors

Vector3 across(const Vector3& n, const Vector3& t) { return n - n.dot(t) * t; }

} // namespace

std::vector<EdgeFrame> mean_normal_frames(const Connectivity& mesh, std::span<const Vector3> positions) {
  std::vector<Vector3> normals(mesh.triangles.size());
  each_in_parallel(normals.size(), [&](std::size_t t) {
    const Corners& v = mesh.triangles[t];
    normals[t] = TriangleArea(positions[v[0]], positions[v[1]], positions[v[2]]).normal;
  });
  std::vector<EdgeFrame> frames(mesh.edges.size());
  each_in_parallel(frames.size(), [&](std::size_t e) {
    const Vector3 t = (positions[mesh.edges[e][1]] - positions[mesh.edges[e][0]]).normalized();
    const auto& sides = mesh.edge_triangles[e];
    Vector3 n = Vector3::Zero();
    for (const auto side : sides)
      if (side != no_index)
        n += normals[side];
    n = across(n, t);
    if (n.norm() < cancelled)
      n = normals[sides[0] != no_index ? sides[0] : sides[1]].cross(t);
    n = across(n, t).normalized();
    frames[e] = {t, n, t.cross(n)};
  });
  return frames;
}

std::vector<EdgeFrame> director_frames(const Connectivity& mesh, std::span<const Vector3> positions,
                                       std::span<const double> angles) {
  std::vector<EdgeFrame> frames = mean_normal_frames(mesh, positions);
  std::vector<double> sine(angles.size()), cosine(angles.size());
  sines_and_cosines(angles, sine, cosine);
  each_in_parallel(angles.size(), [&](std::size_t e) {
    if (angles[e] == 0)
      return;
    const Vector3 n = cosine[e] * frames[e].director + sine[e] * frames[e].binormal;
    frames[e] = {frames[e].tangent, n, frames[e].tangent.cross(n)};
  });
  return frames;
}

} // namespace sheet
