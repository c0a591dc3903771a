// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/delaunay.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

using IndexedPoint = std::pair<Kernel::Point_2, std::uint32_t>;

void canonical(std::vector<TriangleIndices>& triangles) {
  for (TriangleIndices& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
}

std::vector<TriangleIndices> finite_triangles(const Delaunay& delaunay) {
  std::vector<TriangleIndices> triangles;
  triangles.reserve(delaunay.number_of_faces());
  for (const auto face : delaunay.finite_face_handles())
    triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

Delaunay triangulate(const std::vector<IndexedPoint>& points) {
  Delaunay delaunay;
  delaunay.insert(points.begin(), points.end());
  if (delaunay.number_of_vertices() != points.size())
    fail(ExitCode::internal, "Delaunay triangulation: {} of {} points coincide with others",
         points.size() - delaunay.number_of_vertices(), points.size());
  return delaunay;
}

} // namespace

std::vector<TriangleIndices> planar_delaunay(const std::vector<Eigen::Vector3d>& points) {
  std::vector<IndexedPoint> flat;
  flat.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    flat.emplace_back(Kernel::Point_2(points[i].x(), points[i].y()), static_cast<std::uint32_t>(i));
  std::vector<TriangleIndices> triangles = finite_triangles(triangulate(flat));
  canonical(triangles);
  return triangles;
}

std::vector<TriangleIndices> sphere_delaunay(const std::vector<Eigen::Vector3d>& points) {
  // Seen from the +z pole outward is away from the viewer, so the plane is mirrored to keep triangles outward.
  std::vector<IndexedPoint> flat;
  flat.reserve(points.size() - 1);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].normalized();
    flat.emplace_back(Kernel::Point_2(p.x() / (1.0 - p.z()), -p.y() / (1.0 - p.z())), static_cast<std::uint32_t>(i));
  }
  const Delaunay delaunay = triangulate(flat);
  std::vector<TriangleIndices> triangles = finite_triangles(delaunay);
  // What lies beyond the hull's edges is the fan around the pole.
  for (const auto face : delaunay.all_face_handles())
    for (int k = 0; k < 3; ++k)
      if (delaunay.is_infinite(face->vertex(k)))
        triangles.push_back({0, face->vertex(Delaunay::ccw(k))->info(), face->vertex(Delaunay::cw(k))->info()});
  canonical(triangles);
  return triangles;
}

std::vector<TriangleIndices> cap_delaunay(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> flat;
  flat.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d p = point.normalized();
    flat.emplace_back(p.x() / (1.0 + p.z()), p.y() / (1.0 + p.z()), 0.0);
  }
  return planar_delaunay(flat);
}

std::vector<TriangleIndices> tube_delaunay(const std::vector<Eigen::Vector3d>& points, double radius,
                                           double edge_length) {
  const double around = 2.0 * std::numbers::pi * radius;
  const double margin = std::min(5.0 * edge_length, 0.5 * around);
  const std::uint32_t n = static_cast<std::uint32_t>(points.size());
  std::vector<IndexedPoint> flat;
  flat.reserve(points.size() + points.size() / 4);
  std::vector<std::uint32_t> original;
  const auto add = [&](double x, double z, std::uint32_t i) {
    flat.emplace_back(Kernel::Point_2(x, z), static_cast<std::uint32_t>(original.size()));
    original.push_back(i);
  };
  std::vector<double> place(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    place[i] = radius * (std::atan2(points[i].y(), points[i].x()) + std::numbers::pi);
    add(place[i], points[i].z(), i);
  }
  for (std::uint32_t i = 0; i < n; ++i) { // copies beyond the seam on both sides
    if (place[i] < margin)
      add(place[i] + around, points[i].z(), i);
    if (place[i] > around - margin)
      add(place[i] - around, points[i].z(), i);
  }
  std::vector<TriangleIndices> triangles = finite_triangles(triangulate(flat));
  std::erase_if(triangles, [&](const TriangleIndices& t) { return t[0] >= n && t[1] >= n && t[2] >= n; });
  for (TriangleIndices& t : triangles)
    for (std::uint32_t& v : t)
      v = original[v];
  canonical(triangles);
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

void drop_hole(std::vector<TriangleIndices>& triangles, std::size_t rim) {
  std::erase_if(triangles, [&](const TriangleIndices& t) { return t[0] < rim && t[1] < rim && t[2] < rim; });
}

} // namespace sheet
