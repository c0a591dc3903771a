// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/faces.h"

#include <algorithm>

#include "libsheet/geometry/area.h"

namespace sheet {

namespace {

// P and Q [m²].
struct Slant {
  double p, q;
};

class Thickness {
public:
  Thickness(const Connectivity& mesh, std::span<const Vector3> x, std::span<const double> volumes)
      : mesh_(mesh), x_(x) {
    area_.reserve(mesh.triangles.size());
    height_.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Corners& c = mesh.triangles[t];
      area_.push_back(TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
      height_.push_back(volumes[t] / area_.back());
    }
  }

  [[nodiscard]] double rim_side(std::uint32_t edge, std::uint32_t triangle) const {
    const double l = length(edge), h = height_[triangle];
    return RimSide(2 * area_[triangle] / (l * h)).c * h * l;
  }
  [[nodiscard]] double length(std::uint32_t edge) const {
    return (x_[mesh_.edges[edge][1]] - x_[mesh_.edges[edge][0]]).norm();
  }
  [[nodiscard]] double over_length(std::uint32_t edge) const { // the mean beside it
    const auto [one, two] = mesh_.edge_triangles[edge];
    return (height_[one] + height_[two]) / (2 * length(edge));
  }
  [[nodiscard]] Slant slant_at(std::uint32_t edge) const {
    const auto [one, two] = mesh_.edge_triangles[edge];
    return {2 * (area_[one] + area_[two]) / 3, length(edge) * (height_[one] - height_[two]) / 2};
  }

private:
  const Connectivity& mesh_;
  std::span<const Vector3> x_;
  std::vector<double> area_, height_;
};

std::uint32_t opposite(const Connectivity& mesh, std::uint32_t triangle, std::uint32_t edge) {
  const auto& edges = mesh.triangle_edges[triangle];
  return mesh.triangles[triangle][static_cast<std::size_t>(std::ranges::find(edges, edge) - edges.begin())];
}

// `on_rim`: whether vertices are on free rims.
SlopedEdge sloped_edge(const Connectivity& mesh, std::uint32_t edge, const FreeFaces& faces,
                       const std::vector<char>& on_rim) {
  const auto [one, two] = mesh.edge_triangles[edge];
  const auto [a, b] = mesh.edges[edge];
  SlopedEdge sloped{edge, {a, b, opposite(mesh, one, edge), opposite(mesh, two, edge)}};
  if (!faces.closed.empty()) {
    double none = 0;
    sloped.two_faces = 0;
    for (const std::uint32_t v : sloped.vertices) {
      sloped.two_faces += std::max(0.0, 1 - faces.closed[v]) / 4;
      none += std::max(0.0, faces.closed[v] - 1) / 4;
    }
    sloped.one_face = 1 - sloped.two_faces - none;
  }
  if (on_rim[a] != 0 && on_rim[b] != 0)
    sloped.of_thread = sloped.two_faces;
  return sloped;
}

std::vector<char> at_free_rims(const Connectivity& mesh, const FreeFaces& faces) {
  std::vector<char> on(mesh.vertices, 0);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (faces.rims[e] > 0)
      on[mesh.edges[e][0]] = on[mesh.edges[e][1]] = 1;
  return on;
}

// On something, with a face that is free.
bool lies_open(const FreeFaces& faces, std::uint32_t v) {
  return !faces.closed.empty() && faces.closed[v] > 0 && faces.closed[v] < 2;
}

} // namespace

FreeFaces all_free(const Connectivity& mesh) {
  FreeFaces faces;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    faces.rims.push_back(mesh.on_rim(e) ? 1 : 0);
  return faces;
}

std::vector<SlopedEdge> sloped_edges(const Connectivity& mesh, std::span<const Vector3> positions,
                                     std::span<const double> volumes, const FreeFaces& faces, const LeastSlope& least) {
  const Thickness thickness(mesh, positions, volumes);
  const std::vector<char> on_rim = at_free_rims(mesh, faces);
  std::vector<SlopedEdge> sloped;
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    if (mesh.on_rim(e))
      continue;
    const auto [p, q] = thickness.slant_at(e); // the slope is 2 q/p
    const auto [a, b] = mesh.edges[e];
    const double enough = lies_open(faces, a) || lies_open(faces, b) ? least.on_something : least.free;
    if (on_rim[a] != 0 || on_rim[b] != 0 || 2 * std::abs(q) > enough * p)
      sloped.push_back(sloped_edge(mesh, e, faces, on_rim));
  }
  return sloped;
}

double extra_area(const Connectivity& mesh, std::span<const Vector3> positions, std::span<const double> volumes,
                  const FreeFaces& faces, std::span<const double> factors) {
  const Thickness thickness(mesh, positions, volumes);
  const std::vector<char> on_rim = at_free_rims(mesh, faces);
  const auto factor_of = [&](std::uint32_t t) { return factors.empty() ? 1 : factors[t]; };
  double area = 0;
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    const auto [one, two] = mesh.edge_triangles[e];
    if (mesh.on_rim(e)) {
      const std::uint32_t inside = std::min(one, two);
      area += factor_of(inside) * faces.rims[e] * thickness.rim_side(e, inside);
      continue;
    }
    const auto [p, q] = thickness.slant_at(e);
    const SlopedEdge sloped = sloped_edge(mesh, e, faces, on_rim);
    const double of_thread = 1 + sloped.of_thread * thread_slope * thickness.over_length(e);
    area += 0.5 * (factor_of(one) + factor_of(two)) * of_thread *
            (2 * sloped.two_faces * slant(p, q) + sloped.one_face * slant(p, 2 * q));
  }
  return area;
}

} // namespace sheet
