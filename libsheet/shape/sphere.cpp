// SPDX-License-Identifier: GPL-3.0-or-later
// The closed sphere: cube grid, geodesic icosahedron, irregular.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "libsheet/shape/delaunay.h"
#include "libsheet/shape/scatter.h"
#include "libsheet/shape/shape_checks.h"

namespace sheet {

namespace {

// Finds or makes the vertex on an edge of a polyhedron that two faces share, by its integer place on the edge.
class SharedVertices {
public:
  explicit SharedVertices(TriangleMesh& mesh) : mesh_(mesh) {}

  // key: whatever names the vertex, the same from all faces
  std::uint32_t index(const std::array<std::int64_t, 3>& key, const Eigen::Vector3d& position) {
    const auto [place, is_new] = index_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new)
      mesh_.positions.push_back(position);
    return place->second;
  }

private:
  TriangleMesh& mesh_;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> index_;
};

// Six n x n grids, equally spaced in the angles, not on the cube; each square is cut by its shorter diagonal.
TriangleMesh cube_sphere(double radius, std::uint32_t n) {
  TriangleMesh mesh;
  SharedVertices shared(mesh);
  const std::int64_t size = n;
  const auto vertex = [&](const std::array<std::int64_t, 3>& p) { // each coordinate in 0..n, one of them 0 or n
    Eigen::Vector3d x;
    for (int d = 0; d < 3; ++d)
      x[d] = std::tan(0.25 * std::numbers::pi * static_cast<double>(2 * p[d] - size) / static_cast<double>(size));
    return shared.index(p, radius * x.normalized());
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true})
      for (std::int64_t j = 0; j < size; ++j)
        for (std::int64_t i = 0; i < size; ++i) {
          const auto corner = [&](std::int64_t u, std::int64_t v) {
            std::array<std::int64_t, 3> p{};
            p[axis] = far ? size : 0;
            p[(axis + 1) % 3] = far ? u : v; // seen from outside counter-clockwise on both ends of the axis
            p[(axis + 2) % 3] = far ? v : u;
            return vertex(p);
          };
          const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
          const double ac = (mesh.positions[a] - mesh.positions[c]).norm();
          const double bd = (mesh.positions[b] - mesh.positions[d]).norm();
          const bool tie = std::abs(ac - bd) < 1e-12 * radius;
          if (tie ? (i + j) % 2 == 0 : ac < bd) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
          } else {
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({b, c, d});
          }
        }
  return mesh;
}

// Each face of an icosahedron cut into n x n triangles, pressed onto the sphere: 20 n² triangles.
TriangleMesh geodesic_sphere(double radius, std::uint32_t n) {
  // The icosahedron: the cyclic permutations of (0, ±1, ±golden).
  std::array<Eigen::Vector3d, 12> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 4; ++k) {
      Eigen::Vector3d& p = corners[4 * axis + k];
      p[axis] = 0.0;
      p[(axis + 1) % 3] = k % 2 == 0 ? 1.0 : -1.0;
      p[(axis + 2) % 3] = (k / 2 == 0 ? 1.0 : -1.0) * std::numbers::phi;
      p.normalize();
    }
  const double edge = 1.0 / std::sin(0.4 * std::numbers::pi); // of the icosahedron in the unit sphere: 1.0515
  const auto joined = [&](int a, int b) { return (corners[a] - corners[b]).norm() < 1.1 * edge; };
  TriangleMesh mesh;
  SharedVertices shared(mesh);
  const auto add_face = [&](int a, int b, int c) {
    const auto vertex = [&](std::int64_t i, std::int64_t j) { // i steps towards b, j towards c
      const std::int64_t k = n - i - j;
      // The key: up to three (corner, weight) pairs of weight above zero, sorted.
      std::array<std::int64_t, 3> key = {k > 0 ? a * 1'000'000LL + k : -1, i > 0 ? b * 1'000'000LL + i : -1,
                                         j > 0 ? c * 1'000'000LL + j : -1};
      std::array<std::pair<std::int64_t, const Eigen::Vector3d*>, 3> terms = {
          {{key[0], &corners[a]}, {key[1], &corners[b]}, {key[2], &corners[c]}}};
      std::sort(terms.begin(), terms.end()); // the same sum, in the same order, from every face
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (std::size_t t = 0; t < 3; ++t) {
        key[t] = terms[t].first;
        if (key[t] >= 0)
          x += static_cast<double>(key[t] % 1'000'000) * *terms[t].second;
      }
      return shared.index(key, radius * x.normalized());
    };
    for (std::int64_t j = 0; j < n; ++j)
      for (std::int64_t i = 0; i + j < n; ++i) {
        mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
        if (i + j + 1 < n)
          mesh.triangles.push_back({vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
  };
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b)
      for (int c = b + 1; c < 12; ++c)
        if (joined(a, b) && joined(b, c) && joined(c, a)) {
          if (corners[a].dot(corners[b].cross(corners[c])) > 0.0)
            add_face(a, b, c);
          else
            add_face(a, c, b);
        }
  return mesh;
}

TriangleMesh irregular_sphere(double radius, const MeshOptions& options) {
  ScatterSurface surface;
  surface.sample = [=](Random& random) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double z = random.uniform(-1.0, 1.0), r = std::sqrt(1.0 - z * z);
    return Eigen::Vector3d(radius * r * std::cos(angle), radius * r * std::sin(angle), radius * z);
  };
  surface.rim_distance = [](const Eigen::Vector3d&) { return std::numeric_limits<double>::infinity(); };
  surface.project = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d { return radius * p.normalized(); };
  surface.triangulate = sphere_delaunay;
  surface.area = 4.0 * std::numbers::pi * radius * radius;
  surface.euler_characteristic = 2;
  // Euler counts no rim vertices here; the fixed pole is one of the free ones.
  return irregular_mesh(surface, {Eigen::Vector3d(0.0, 0.0, radius)}, options.edge_length, options.seed);
}

} // namespace

TriangleMesh make_sphere(double radius, const MeshOptions& options) {
  check_length("sphere", "radius", radius);
  if (const auto segments = explicit_segments("sphere", options, {1, 1}, 12.0))
    return cube_sphere(radius, (*segments)[0]);
  const double length = options.edge_length, area = 4.0 * std::numbers::pi * radius * radius;
  check_edge_length("sphere", length, 1.0515 * radius, area);
  switch (options.pattern) {
  case Pattern::structured: // 12 n² triangles; the mean edge is 1.13 times the square root of twice a triangle's area
    return cube_sphere(radius, segments_of(1.13 * std::sqrt(area / 6.0), length));
  case Pattern::equilateral: // 20 n² triangles
    return geodesic_sphere(radius, segments_of(std::sqrt(area / (5.0 * std::numbers::sqrt3)), length));
  case Pattern::irregular:
    break;
  }
  return irregular_sphere(radius, options);
}

} // namespace sheet
