// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sheet::render {
namespace {

constexpr int bead_segments = 6; // of the half circle

// Normals of the faces around each vertex, weighted by their angles there.
std::vector<Vector3> vertex_normals(std::span<const Vector3> x, std::span<const Corners> triangles) {
  std::vector<Vector3> sum(x.size(), Vector3::Zero()), any(x.size(), Vector3::UnitY());
  for (const Corners& t : triangles) {
    const Vector3 n = area_normal(x, t).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 a = x[t[(i + 1) % 3]] - x[t[i]], b = x[t[(i + 2) % 3]] - x[t[i]];
      sum[t[i]] += std::atan2(a.cross(b).norm(), a.dot(b)) * n;
      any[t[i]] = n;
    }
  }
  for (std::size_t v = 0; v < x.size(); ++v) // where faces of opposite orientation meet, one of them decides
    sum[v] = sum[v].norm() > 1e-6 ? Vector3(sum[v].normalized()) : any[v];
  return sum;
}

// Those of the last parting's points between those of their edges' ends, as it is fine.
std::vector<Vector3> normals_of(const Middle& middle) {
  std::vector<Vector3> normals = vertex_normals(middle.positions, middle.triangles);
  std::size_t point = normals.size() - middle.of_edges.size();
  for (const auto& [a, b] : middle.of_edges) {
    Vector3& own = normals[point++];
    const Vector3 drawn_back = (1 - middle.fineness) * (normals[a] + normals[b]) / 2 + middle.fineness * own;
    if (middle.fineness < 1 && drawn_back.norm() > 1e-3)
      own = drawn_back.normalized();
  }
  return normals;
}

struct RimEdge {
  std::uint32_t from, to, triangle; // along the triangle
};

// Edges that a single triangle has.
std::vector<RimEdge> rim_of(std::span<const Corners> triangles) {
  std::vector<RimEdge> edges;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back({triangles[t][i], triangles[t][(i + 1) % 3], t});
  const auto key = [](const RimEdge& e) { return std::minmax(e.from, e.to); };
  std::stable_sort(edges.begin(), edges.end(),
                   [&](const RimEdge& a, const RimEdge& b) { return std::pair(key(a)) < std::pair(key(b)); });
  std::vector<RimEdge> rim;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    for (end = i + 1; end < edges.size() && std::pair(key(edges[end])) == std::pair(key(edges[i])); ++end) {
    }
    if (end == i + 1)
      rim.push_back(edges[i]);
  }
  return rim;
}

// The half-round bead between the two sides. Its first and last rings are the sides' own vertices, `count` apart.
void add_bead(std::span<const Vector3> x, std::span<const Corners> triangles, std::span<const Vector3> normals,
              std::span<const double> thickness, std::uint32_t count, Surface& surface) {
  const std::vector<RimEdge> rim = rim_of(triangles);
  std::vector<Vector3> outward(x.size(), Vector3::Zero());
  for (const RimEdge& e : rim) {
    const Vector3 out = (x[e.to] - x[e.from]).cross(area_normal(x, triangles[e.triangle])).normalized();
    outward[e.from] += out;
    outward[e.to] += out;
  }
  std::vector<std::uint32_t> first_ring(x.size(), 0); // index of its first point between the sides
  const auto ring = [&](std::uint32_t v, int j) {
    return j == 0 ? v : j == bead_segments ? v + count : first_ring[v] + static_cast<std::uint32_t>(j - 1);
  };
  const auto place = [&](std::uint32_t v) {
    if (first_ring[v] != 0)
      return;
    first_ring[v] = static_cast<std::uint32_t>(surface.positions.size());
    Vector3 out = outward[v] - outward[v].dot(normals[v]) * normals[v];
    if (out.norm() < 1e-6) // a pinch between two rims
      out = normals[v].unitOrthogonal();
    out.normalize();
    for (int j = 1; j < bead_segments; ++j) {
      const double angle = std::numbers::pi * j / bead_segments;
      const Vector3 direction = std::cos(angle) * normals[v] + std::sin(angle) * out;
      surface.positions.push_back(x[v] + 0.5 * thickness[v] * direction);
      surface.normals.push_back(direction.cast<float>());
      surface.source_vertex.push_back(v);
    }
  };
  for (const RimEdge& e : rim) {
    place(e.from);
    place(e.to);
    for (int j = 0; j < bead_segments; ++j) {
      const std::uint32_t a = ring(e.from, j), b = ring(e.to, j), c = ring(e.from, j + 1), d = ring(e.to, j + 1);
      for (const Corners& t : {Corners{a, c, b}, Corners{b, c, d}}) {
        surface.triangles.push_back(t);
        surface.source_triangle.push_back(e.triangle);
        surface.on_bead.push_back(true);
      }
    }
  }
}

} // namespace

Surface make_surface(const Middle& middle, double thinnest) {
  const auto& [x, h, triangles, source, of_edges, fineness] = middle;
  double area = 0, volume = 0;
  for (const Corners& t : triangles) {
    const double a = area_normal(x, t).norm();
    area += a;
    volume += a * (h[t[0]] + h[t[1]] + h[t[2]]) / 3;
  }
  Surface s;
  s.closed = volume > thinnest * area;
  s.thickness.assign(h.begin(), h.end());
  const std::vector<Vector3> normals = normals_of(middle);
  const auto count = static_cast<std::uint32_t>(x.size());
  for (const double side : {0.5, -0.5}) {
    if (!s.closed && side < 0)
      break;
    for (std::uint32_t v = 0; v < count; ++v) {
      s.positions.push_back(s.closed ? Vector3(x[v] + side * h[v] * normals[v]) : x[v]);
      s.normals.push_back((side > 0 ? normals[v] : Vector3(-normals[v])).cast<float>());
      s.source_vertex.push_back(v);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Corners& c = triangles[t];
      s.triangles.push_back(side > 0 ? c : Corners{c[0] + count, c[2] + count, c[1] + count});
      s.source_triangle.push_back(source[t]);
      s.on_bead.push_back(false);
    }
  }
  if (s.closed) {
    const std::size_t flat = s.triangles.size();
    add_bead(x, triangles, normals, h, count, s);
    for (std::size_t t = flat; t < s.triangles.size(); ++t)
      s.source_triangle[t] = source[s.source_triangle[t]];
  }
  return s;
}

} // namespace sheet::render
