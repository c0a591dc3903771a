// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/remesh/numbering.h"

#include <algorithm>

namespace sheet::remesh {

namespace {

constexpr std::size_t small_mesh = 32768;
constexpr double far_apart = 0.05; // of all numbers
constexpr int bits = 21;           // of each coordinate

// The bits of x, two zeros before each.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffU;
  x = (x | x << 16) & 0x001f0000ff0000ffU;
  x = (x | x << 8) & 0x100f00f00f00f00fU;
  x = (x | x << 4) & 0x10c30c30c30c30c3U;
  return (x | x << 2) & 0x1249249249249249U;
}

bool is_scattered(const Numbering& n, const Mesh& mesh) {
  const std::size_t count = n.vertices.size();
  if (count <= small_mesh)
    return false;
  double sum = 0;
  for (const std::uint32_t t : n.triangles) {
    const Corners& c = mesh.corners(t);
    const auto [least, most] = std::minmax({n.number[c[0]], n.number[c[1]], n.number[c[2]]});
    sum += most - least;
  }
  return sum > far_apart * static_cast<double>(count) * static_cast<double>(n.triangles.size());
}

void order_along_curve(const Mesh& mesh, std::span<const Vector3> positions, Numbering& n) {
  Vector3 low = positions[n.vertices[0]], high = low;
  for (const std::uint32_t v : n.vertices) {
    low = low.cwiseMin(positions[v]);
    high = high.cwiseMax(positions[v]);
  }
  const double scale = ((1 << bits) - 1) / (high - low).maxCoeff();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  for (const std::uint32_t v : n.vertices) {
    const Vector3 x = scale * (positions[v] - low);
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis)
      place |= spread_bits(static_cast<std::uint64_t>(x[axis])) << axis;
    places.emplace_back(place, v);
  }
  std::sort(places.begin(), places.end());
  for (std::size_t i = 0; i < places.size(); ++i) {
    n.vertices[i] = places[i].second;
    n.number[n.vertices[i]] = static_cast<std::uint32_t>(i);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> first; // corner, triangle
  for (const std::uint32_t t : n.triangles) {
    const Corners& c = mesh.corners(t);
    first.emplace_back(std::min({n.number[c[0]], n.number[c[1]], n.number[c[2]]}), t);
  }
  std::sort(first.begin(), first.end());
  std::transform(first.begin(), first.end(), n.triangles.begin(), [](const auto& pair) { return pair.second; });
}

} // namespace

Numbering numbering(const Mesh& mesh, std::span<const Vector3> positions) {
  Numbering n;
  n.number.assign(mesh.vertex_slots(), no_index);
  for (std::uint32_t v = 0; v < mesh.vertex_slots(); ++v)
    if (mesh.has_vertex(v)) {
      n.number[v] = static_cast<std::uint32_t>(n.vertices.size());
      n.vertices.push_back(v);
    }
  for (std::uint32_t t = 0; t < mesh.triangle_slots(); ++t)
    if (mesh.has_triangle(t))
      n.triangles.push_back(t);
  if (is_scattered(n, mesh))
    order_along_curve(mesh, positions, n);
  return n;
}

} // namespace sheet::remesh
