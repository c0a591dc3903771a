// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/free_faces.h"

#include <algorithm>
#include <cmath>

#include "libsheet/scene/inner_faces.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/contact_spring.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::scene {

namespace {

using formats::Frame;

// Of an outward direction, what a hold leaves free: less counts as held.
constexpr double least_free = 0.1;

// Of each vertex the axes that no hold prescribes, as a vector of ones and zeros.
std::vector<Vector3> free_axes(const Scene& scene, const Frame& frame) {
  std::vector<Vector3> free(frame.vertices, Vector3::Ones());
  const auto masks = holds(frame);
  for (std::size_t i = 0; i < scene.holds.size() && !masks.empty(); ++i)
    if (in_force(scene.holds[i], frame.time))
      for (std::size_t v = 0; v < free.size(); ++v)
        if ((masks[v] >> i & 1) != 0)
          for (int axis = 0; axis < 3; ++axis)
            if (has_axis(scene.holds[i].axes, axis))
              free[v][axis] = 0;
  return free;
}

// Vertices in an inlet that is open, or welded onto a layer.
std::vector<char> joined(const Scene& scene, const Frame& frame) {
  std::vector<char> result(frame.vertices, 0);
  const auto inlet = masks(frame, "inlet");
  for (std::size_t i = 0; i < scene.inflows.size() && !inlet.empty(); ++i)
    if (in_force(scene.inflows[i], frame.time))
      for (std::size_t v = 0; v < result.size(); ++v)
        if (of_inlet(inlet[v], i) != 0)
          result[v] = 1;
  for (const ContactSpring& spring : read_springs(frame))
    if (spring.welded())
      result[spring.vertices[0]] = 1;
  return result;
}

// In the sheet, out of it, across a rim edge.
Vector3 outward(const Connectivity& mesh, std::span<const Vector3> x, std::uint32_t edge) {
  const auto [a, b] = mesh.edges[edge];
  const auto& sides = mesh.edge_triangles[edge];
  const Corners& c = mesh.triangles[std::min(sides[0], sides[1])];
  const Vector3 along = (x[b] - x[a]).normalized(), middle = (x[c[0]] + x[c[1]] + x[c[2]]) / 3;
  const Vector3 out = x[a] - middle;
  return (out - out.dot(along) * along).normalized();
}

bool flows_out(const Scene& scene, const Vector3& a, const Vector3& b) {
  const double near = (b - a).norm();
  return std::ranges::any_of(scene.outflows, [&](const Outflow& o) {
    const auto past = [&](const Vector3& x) { return o.normal.dot(x - o.point) / o.normal.norm(); };
    return past(a) > -near && past(b) > -near;
  });
}

} // namespace

FreeFaces free_faces(const Scene& scene, const Frame& frame, const Connectivity& mesh) {
  FreeFaces faces = all_free(mesh);
  const auto x = positions(frame);
  const std::vector<Vector3> free = free_axes(scene, frame);
  const std::vector<char> join = joined(scene, frame);
  std::vector<char> angled(frame.vertices, 0); // vertices on solids that have a contact angle
  faces.closed = inner_faces(scene, frame);
  if (!scene.solids.empty()) {
    const auto touched = touched_solids(frame, scene.solids.size());
    faces.closed.resize(frame.vertices, 0);
    for (std::size_t v = 0; v < frame.vertices; ++v)
      if (const std::int32_t solid = touched[v]; solid != no_solid) {
        angled[v] = scene.solids[static_cast<std::size_t>(solid)].contact_angle.has_value();
        faces.closed[v] = std::min(2.0, faces.closed[v] + 1);
      }
  }
  const auto buried = [&](std::uint32_t v) { return faces.closed.empty() ? 0 : std::max(0.0, faces.closed[v] - 1); };
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    if (faces.rims[e] == 0)
      continue;
    const Edge& ends = mesh.edges[e];
    const Vector3 out = outward(mesh, x, e);
    const auto held = [&](std::uint32_t v) { return out.cwiseProduct(free[v]).norm() < least_free; };
    if ((join[ends[0]] != 0 && join[ends[1]] != 0) || (held(ends[0]) && held(ends[1])) ||
        flows_out(scene, x[ends[0]], x[ends[1]]))
      faces.rims[e] = 0;
    else
      faces.rims[e] = (1 - 0.5 * (angled[ends[0]] + angled[ends[1]])) * (1 - 0.5 * (buried(ends[0]) + buried(ends[1])));
  }
  return faces;
}

} // namespace sheet::scene
