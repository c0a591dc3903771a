// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/mesh_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace sheet {

namespace {

// The angle between two vectors [rad].
double angle_between(const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

std::array<double, 3> angles(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return {angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)};
}

} // namespace

double smallest_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const auto [alpha, beta, gamma] = angles(a, b, c);
  return std::min({alpha, beta, gamma});
}

std::vector<MeshEdge> mesh_edges(const std::vector<TriangleIndices>& triangles) {
  std::vector<MeshEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const TriangleIndices& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = t[k], to = t[(k + 1) % 3];
      edges.push_back(from < to ? MeshEdge{from, to, 1, 0} : MeshEdge{to, from, 0, 1});
    }
  std::sort(edges.begin(), edges.end(),
            [](const MeshEdge& x, const MeshEdge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  std::size_t kept = 0;
  for (const MeshEdge& edge : edges) {
    if (kept > 0 && edges[kept - 1].a == edge.a && edges[kept - 1].b == edge.b) {
      edges[kept - 1].up += edge.up;
      edges[kept - 1].down += edge.down;
    } else {
      edges[kept++] = edge;
    }
  }
  edges.resize(kept);
  return edges;
}

MeshFigures measure(const TriangleMesh& mesh) {
  MeshFigures f;
  f.vertices = mesh.positions.size();
  f.triangles = mesh.triangles.size();
  const std::vector<MeshEdge> edges = mesh_edges(mesh.triangles);
  f.edges = edges.size();
  f.edge_min = std::numeric_limits<double>::infinity();
  for (const MeshEdge& edge : edges) {
    const double length = (mesh.positions[edge.a] - mesh.positions[edge.b]).norm();
    f.edge_min = std::min(f.edge_min, length);
    f.edge_max = std::max(f.edge_max, length);
    f.edge_mean += length / static_cast<double>(edges.size());
    f.boundary_edges += edge.up + edge.down == 1 ? 1 : 0;
    f.bad_edges += edge.up > 1 || edge.down > 1 ? 1 : 0;
  }
  f.angle_min = std::numbers::pi;
  for (const TriangleIndices& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    for (const double angle : angles(a, b, c)) {
      f.angle_min = std::min(f.angle_min, angle);
      f.angle_max = std::max(f.angle_max, angle);
    }
    f.area += 0.5 * (b - a).cross(c - a).norm();
    f.volume += a.dot(b.cross(c)) / 6.0;
  }
  return f;
}

std::vector<Eigen::Vector3d> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> normals(mesh.positions.size(), Eigen::Vector3d::Zero());
  for (const TriangleIndices& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Eigen::Vector3d normal = (b - a).cross(c - a).stableNormalized();
    const std::array<double, 3> weight = angles(a, b, c);
    for (int k = 0; k < 3; ++k)
      normals[t[k]] += weight[k] * normal;
  }
  for (Eigen::Vector3d& normal : normals)
    normal = normal.stableNormalized();
  return normals;
}

} // namespace sheet
