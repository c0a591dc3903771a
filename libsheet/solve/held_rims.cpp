// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/held_rims.h"

#include <algorithm>

#include "libsheet/geometry/axes.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

// Whether a rim that faces this way is led along by a hold of these axes, and can neither advance nor retreat.
bool is_led(const Vector3& out, Axes held) {
  for (int a = 0; a < 3; ++a)
    if (has_axis(held, a) && 2 * out[a] * out[a] > out.squaredNorm())
      return true;
  return false;
}

constexpr double sharpest = 0.866; // cosine of half the angle by which a rim turns at a vertex that has one direction

// At each vertex of the free rim.
struct FreeRim {
  Vector3 out = Vector3::Zero(); // of the sheet, with the length of its edges
  double length = 0;             // of these [m]
};

std::vector<FreeRim> free_rims(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh) {
  const auto x = positions(frame);
  const std::vector<Axes> prescribed = scene::prescribed_axes(frame, scene, frame.time);
  std::vector<FreeRim> rims(mesh.vertices);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!mesh.on_rim(mesh.triangle_edges[t][k]))
        continue;
      const std::uint32_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
      const Vector3 edge = x[b] - x[a], normal = edge.cross(x[mesh.triangles[t][k]] - x[a]).normalized();
      const Vector3 outward = edge.cross(normal);
      if (is_led(outward, prescribed[a] & prescribed[b]))
        continue;
      for (const auto v : {a, b}) {
        rims[v].out += outward;
        rims[v].length += outward.norm();
      }
    }
  return rims;
}

// Of solids on each vertex, or in a first step, of which nothing is known, against gravity, without a scale.
std::vector<Vector3> pushes(const Scene& scene, const formats::Frame& frame) {
  if (const formats::Array* array = frame.find("touch_force")) {
    const auto force = array->values<Vector3>();
    return {force.begin(), force.end()};
  }
  return std::vector<Vector3>(frame.vertices, -scene.environment.gravity.value_or(Vector3::Zero()));
}

} // namespace

bool holds_rims(const Scene& scene) {
  return std::ranges::any_of(scene.solids,
                             [](const scene::Solid& s) { return s.contact == SolidContact::flow && !s.receding; });
}

HeldRims held_rims(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh,
                   std::span<const std::uint32_t> touching, std::span<const std::int32_t> turned_to) {
  HeldRims held;
  const std::vector<Vector3> push = pushes(scene, frame);
  const std::vector<FreeRim> rims = free_rims(scene, frame, mesh);
  for (const std::uint32_t v : touching) {
    const auto& [out, length] = rims[v];
    const bool kept = push[v].dot(out) > 0 && turned_to[v] == no_solid;
    const bool slides = out.norm() > sharpest * length;
    if (kept && !slides)
      held.wholly.push_back(v);
    held.out.push_back(kept && slides ? Vector3(out.normalized()) : Vector3(Vector3::Zero()));
  }
  return held;
}

} // namespace sheet
