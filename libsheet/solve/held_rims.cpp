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

// Out of the sheet, at each vertex of its free rim; zero elsewhere.
std::vector<Vector3> rim_directions(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh) {
  const auto x = positions(frame);
  const std::vector<Axes> prescribed = scene::prescribed_axes(frame, scene, frame.time);
  std::vector<Vector3> out(mesh.vertices, Vector3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!mesh.on_rim(mesh.triangle_edges[t][k]))
        continue;
      const std::uint32_t a = mesh.triangles[t][(k + 1) % 3], b = mesh.triangles[t][(k + 2) % 3];
      const Vector3 edge = x[b] - x[a], normal = edge.cross(x[mesh.triangles[t][k]] - x[a]).normalized();
      const Vector3 outward = edge.cross(normal);
      if (is_led(outward, prescribed[a] & prescribed[b]))
        continue;
      for (const auto v : {a, b})
        out[v] += outward;
    }
  return out;
}

} // namespace

bool holds_rims(const Scene& scene) {
  return std::ranges::any_of(scene.solids,
                             [](const scene::Solid& s) { return s.contact == SolidContact::flow && !s.receding; });
}

std::vector<std::uint32_t> held_rims(const Scene& scene, const formats::Frame& frame, const Connectivity& mesh,
                                     std::span<const std::uint32_t> touching) {
  const formats::Array* array = frame.find("touch_force");
  if (array == nullptr)
    return {};
  const auto force = array->values<Vector3>();
  const std::vector<Vector3> out = rim_directions(scene, frame, mesh);
  const auto retreats = [&](std::uint32_t v) { return force[v].dot(out[v]) > 0; };
  std::vector<std::uint32_t> held;
  std::ranges::copy_if(touching, std::back_inserter(held), retreats);
  return held;
}

} // namespace sheet
