// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/beside_walls.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "libsheet/geometry/area.h"
#include "libsheet/geometry/connectivity.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

// A part of a rim: a side of a triangle.
struct RimSide {
  Vector3 middle, outward; // outward: unit, along the triangle
  double length, thickness;
  std::int32_t flows_on; // the solid along which it flows, or no_solid
};

std::vector<RimSide> free_rim(const Scene& scene, const formats::Frame& first, const Connectivity& mesh) {
  const auto x = positions(first);
  const auto held = holds(first);
  const auto volume = volumes(first);
  const auto touch = touched_solids(first, scene.solids.size());
  const auto flows_on = [&](std::uint32_t a, std::uint32_t b) {
    const std::int32_t solid = touch[a] == touch[b] ? touch[a] : no_solid;
    const bool flows =
        solid != no_solid && scene.solids[static_cast<std::size_t>(solid)].contact != SolidContact::stick;
    return flows ? solid : no_solid;
  };
  const auto is_held = [&](std::uint32_t v) { return !held.empty() && held[v] != 0; };
  std::vector<RimSide> sides;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [a, b] = mesh.edges[e];
    if (!mesh.on_rim(e) || (is_held(a) && is_held(b)))
      continue;
    const std::uint32_t t = std::min(mesh.edge_triangles[e][0], mesh.edge_triangles[e][1]); // the other one is no_index
    const Corners& c = mesh.triangles[t];
    const TriangleArea triangle(x[c[0]], x[c[1]], x[c[2]]);
    const Vector3 along = x[b] - x[a], inward = (x[c[0]] + x[c[1]] + x[c[2]]) / 3 - x[a];
    const Vector3 out = along.dot(inward) / along.squaredNorm() * along - inward;
    sides.push_back({(x[a] + x[b]) / 2, out.normalized(), along.norm(), volume[t] / triangle.area, flows_on(a, b)});
  }
  return sides;
}

} // namespace

std::string beside_walls_warning(const Scene& scene, const formats::Frame& first) {
  constexpr double much = 0.05;                  // of the area
  constexpr double upright = 0.3, edge_on = 0.7; // cosines: of the face with gravity, of the rim with the face
  const auto up = scene::up(scene.environment);
  if (scene.solids.empty() || !up)
    return "";
  const Connectivity mesh = connect(first.vertices, triangles(first));
  const solid::Solids solids(scene);
  std::vector<double> lost(solids.size(), 0), nearest(solids.size(), 0); // [m²]; [m]
  double thickness = 0;
  for (const RimSide& side : free_rim(scene, first, mesh))
    for (std::size_t s = 0; s < solids.size(); ++s) {
      if (side.flows_on != no_solid && side.flows_on != static_cast<std::int32_t>(s))
        continue; // it stays where it is
      const solid::SolidPoint there = solids.at(s, side.middle, first.time);
      if (there.distance > side.thickness / 8 || std::abs(up->dot(there.normal)) > upright ||
          -side.outward.dot(there.normal) < edge_on)
        continue;
      nearest[s] = lost[s] == 0 ? there.distance : std::min(nearest[s], there.distance);
      lost[s] += (side.thickness / 4 - there.distance) * side.length;
      thickness = std::max(thickness, side.thickness);
    }
  double all = 0, area = 0;
  for (const double one : lost)
    all += one;
  const auto x = positions(first);
  for (const Corners& c : mesh.triangles)
    area += TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area;
  if (all < much * area)
    return "";
  const auto most = static_cast<std::size_t>(std::ranges::max_element(lost) - lost.begin());
  const auto sides = std::ranges::count_if(lost, [](double one) { return one > 0; });
  return fmt::format(
      "the sheet's rim starts {:.2g} m from {}{}, upright beside it: what is nearer than an eighth of the "
      "thickness, {:.2g} m, is put up to a quarter of it off that in the first step, and the layer becomes "
      "about {:.0f} % thicker by the room that it loses. What begins that eighth off stays there",
      std::max(0.0, nearest[most]), solids.name(most), sides > 1 ? fmt::format(" (and from {} more)", sides - 1) : "",
      thickness / 8, 100 * all / (area - std::min(all, 0.9 * area)));
}

} // namespace sheet
