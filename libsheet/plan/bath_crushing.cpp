// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/bath_crushing.h"

#include <vector>

#include <fmt/format.h>

#include "libsheet/geometry/connectivity.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/sheet/enclosures.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

std::string bath_crushing_warning(const Scene& scene, const formats::Frame& first) {
  const auto up = scene::up(scene.environment);
  const auto enclosed = enclosures(first);
  if (!scene.environment.bath || !up || (scene.environment.pressure && enclosed.empty()))
    return "";
  const auto x = positions(first);
  const Connectivity mesh = connect(first.vertices, triangles(first));
  DisjointSets pieces(first.vertices);
  for (const Edge& edge : mesh.edges)
    pieces.join(edge[0], edge[1]);
  std::vector<char> withstands(first.vertices, 0); // of a piece, at its first vertex: it is open, or has pressure in it
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (mesh.on_rim(e))
      withstands[pieces.find(mesh.edges[e][0])] = 1;
  for (std::size_t t = 0; t < enclosed.size(); ++t)
    if (enclosed[t] != 0 && scene.environment.pressure)
      withstands[pieces.find(mesh.triangles[t][0])] = 1;
  for (const Corners& corners : mesh.triangles)
    for (const std::uint32_t v : corners)
      if (withstands[pieces.find(v)] == 0 && up->dot(x[v]) < scene.environment.bath->level)
        return fmt::format("the bath crushes what is closed and has no gas in it, at ({:g}, {:g}, {:g}) m: pressure = "
                           "{{law = \"gas\", value = 0}} in [environment] fills it with air",
                           x[v].x(), x[v].y(), x[v].z());
  return "";
}

} // namespace sheet
