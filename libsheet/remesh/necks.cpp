// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/necks.h"

#include <algorithm>
#include <array>
#include <limits>

namespace sheet::remesh {

namespace {

constexpr std::size_t least_part = 32; // triangles on either side of a neck

using Ring = std::array<std::uint32_t, 3>; // vertices of three edges in a circle

double length(const EditableSheet& sheet, std::uint32_t a, std::uint32_t b) {
  return (sheet.at(a) - sheet.at(b)).norm();
}

// Whether at least so many triangles can be reached from one beside the ring's first edge without crossing the ring.
bool has_part(const Mesh& mesh, const Ring& ring, std::uint32_t first) {
  const auto in_ring = [&](std::uint32_t v) { return std::ranges::find(ring, v) != ring.end(); };
  std::vector<std::uint32_t> reached = {Mesh::triangle_of(first)};
  for (std::size_t i = 0; i < reached.size() && reached.size() < least_part; ++i)
    for (std::uint32_t side = 3 * reached[i]; side < 3 * reached[i] + 3; ++side) {
      const std::uint32_t twin = mesh.twin(side);
      if (twin == no_index || (in_ring(mesh.from(side)) && in_ring(mesh.to(side))))
        continue;
      if (const std::uint32_t t = Mesh::triangle_of(twin); std::ranges::find(reached, t) == reached.end())
        reached.push_back(t);
    }
  return reached.size() >= least_part;
}

// visit(ring) for each three edges through a side that go round something.
template <class Visit> void for_rings(const Mesh& mesh, std::uint32_t side, Visit visit) {
  const std::uint32_t a = mesh.from(side), b = mesh.to(side);
  const std::array beside = {mesh.apex(side), mesh.apex(mesh.twin(side))};
  mesh.for_neighbours(a, [&](std::uint32_t c) {
    if (std::ranges::find(beside, c) == beside.end() && c != b && mesh.adjacent(b, c) && !mesh.on_rim(c))
      visit(Ring{a, b, c});
  });
}

} // namespace

std::vector<double> neck_widths(const EditableSheet& sheet, double widest) {
  const Mesh& mesh = sheet.mesh();
  std::vector<double> width(mesh.vertex_slots(), std::numeric_limits<double>::infinity());
  for (std::uint32_t side = 0; side < 3 * mesh.triangle_slots(); ++side) {
    if (!mesh.has_triangle(Mesh::triangle_of(side)))
      continue;
    const std::uint32_t a = mesh.from(side), b = mesh.to(side);
    if (mesh.twin(side) == no_index || a > b || mesh.on_rim(a) || mesh.on_rim(b) || length(sheet, a, b) > widest)
      continue;
    for_rings(mesh, side, [&](const Ring& ring) {
      const auto [least, greatest] =
          std::minmax({length(sheet, a, b), length(sheet, b, ring[2]), length(sheet, ring[2], a)});
      if (greatest > 2 * widest || !has_part(mesh, ring, side) || !has_part(mesh, ring, mesh.twin(side)))
        return;
      for (const std::uint32_t v : ring)
        width[v] = std::min(width[v], least);
    });
  }
  return width;
}

} // namespace sheet::remesh
