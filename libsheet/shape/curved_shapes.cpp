// SPDX-License-Identifier: GPL-3.0-or-later
// Cap and tube: pieces of a sphere and of a cylinder.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libsheet/base/error.h"
#include "libsheet/geometry/types.h"
#include "libsheet/shape/delaunay.h"
#include "libsheet/shape/grids.h"
#include "libsheet/shape/scatter.h"
#include "libsheet/shape/shape_checks.h"

namespace sheet {

namespace {

void append_parallel(double radius, double polar, std::uint32_t count, double phase, Points& points) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = two_pi * (i + phase) / count;
    points.emplace_back(radius * std::sin(polar) * std::cos(angle), radius * std::sin(polar) * std::sin(angle),
                        radius * std::cos(polar));
  }
}

// ---- cap -------------------------------------------------------------------------------------------------------

// Rings around the axis at equal distances; `count(polar angle)` vertices each, every second one turned by half an edge
// if asked for.
template <class Count>
TriangleMesh cap_rings(double radius, double opening, double angle, std::uint32_t rows, bool turned, Count count) {
  TriangleMesh mesh;
  Ring last;
  for (std::uint32_t k = 0; k <= rows; ++k) {
    const double polar = opening + (angle - opening) * k / rows;
    const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
    if (polar == 0.0) {
      mesh.positions.emplace_back(0.0, 0.0, radius);
      continue;
    }
    const Ring ring{first, count(polar)};
    append_parallel(radius, polar, ring.count, turned && k % 2 == 1 ? 0.5 : 0.0, mesh.positions);
    if (last.count > 0)
      stitch_rings(mesh.positions, last, ring, mesh.triangles);
    else if (k > 0)
      fan(0, ring, mesh.triangles);
    last = ring;
  }
  return mesh;
}

TriangleMesh cap_irregular(double radius, double opening, double angle, const MeshOptions& options) {
  const double length = options.edge_length;
  Points rim;
  if (opening > 0.0)
    append_parallel(radius, opening, segments_of(two_pi * radius * std::sin(opening), length, 6), 0.0, rim);
  const std::size_t hole = rim.size();
  append_parallel(radius, angle, segments_of(two_pi * radius * std::sin(angle), length, 6), 0.0, rim);
  ScatterSurface surface;
  surface.sample = [=](Random& random) {
    const double turn = random.uniform(0.0, two_pi);
    const double z = random.uniform(std::cos(angle), std::cos(opening));
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    return Eigen::Vector3d(radius * r * std::cos(turn), radius * r * std::sin(turn), radius * z);
  };
  surface.rim_distance = [=](const Eigen::Vector3d& p) {
    const double polar = std::atan2(std::hypot(p.x(), p.y()), p.z());
    return radius * std::min(angle - polar, opening > 0.0 ? polar - opening : std::numeric_limits<double>::infinity());
  };
  surface.project = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d { return radius * p.normalized(); };
  surface.triangulate = [=](const Points& points) {
    std::vector<TriangleIndices> triangles = cap_delaunay(points);
    drop_hole(triangles, hole);
    return triangles;
  };
  surface.area = two_pi * radius * radius * (std::cos(opening) - std::cos(angle));
  surface.euler_characteristic = opening > 0.0 ? 0 : 1;
  return irregular_mesh(surface, std::move(rim), length, options.seed);
}

// ---- tube ------------------------------------------------------------------------------------------------------

TriangleMesh tube_grid(double radius, double height, std::uint32_t around, std::uint32_t along, bool turned) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = two_pi * (i + (turned && j % 2 == 1 ? 0.5 : 0.0)) / around;
      mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                  height * (static_cast<double>(j) / along - 0.5));
    }
  if (!turned) {
    mesh.triangles = grid_triangles(around, along, true);
    return mesh;
  }
  for (std::uint32_t j = 0; j < along; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t next = (i + 1) % around, low = j * around, high = low + around;
      if (j % 2 == 0) { // the upper row is half an edge ahead
        mesh.triangles.push_back({low + i, low + next, high + i});
        mesh.triangles.push_back({low + next, high + next, high + i});
      } else {
        mesh.triangles.push_back({low + i, high + next, high + i});
        mesh.triangles.push_back({low + i, low + next, high + next});
      }
    }
  return mesh;
}

TriangleMesh tube_irregular(double radius, double height, const MeshOptions& options) {
  const double length = options.edge_length, half = 0.5 * height;
  const std::uint32_t around = segments_of(two_pi * radius, length, 6);
  Points rim;
  for (const double z : {-half, half})
    for (std::uint32_t i = 0; i < around; ++i)
      rim.emplace_back(radius * std::cos(two_pi * i / around), radius * std::sin(two_pi * i / around), z);
  ScatterSurface surface;
  surface.sample = [=](Random& random) {
    const double angle = random.uniform(0.0, two_pi);
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), random.uniform(-half, half));
  };
  surface.rim_distance = [=](const Eigen::Vector3d& p) { return half - std::abs(p.z()); };
  surface.project = [=](const Eigen::Vector3d& p) {
    const double scale = radius / std::hypot(p.x(), p.y());
    return Eigen::Vector3d(scale * p.x(), scale * p.y(), p.z());
  };
  surface.triangulate = [=](const Points& points) { return tube_delaunay(points, radius, length); };
  surface.area = two_pi * radius * height;
  surface.euler_characteristic = 0;
  return irregular_mesh(surface, std::move(rim), length, options.seed);
}

} // namespace

TriangleMesh make_cap(double radius, double angle, const MeshOptions& options, double opening) {
  check_length("cap", "radius", radius);
  if (!(angle > 0.0 && angle < std::numbers::pi))
    fail(ExitCode::bad_input, "cap: angle = {:g} rad must lie between 0 and pi (a whole sphere is shape = \"sphere\")",
         angle);
  if (!(opening >= 0.0 && opening < angle))
    fail(ExitCode::bad_input, "cap: opening = {:g} rad must lie between 0 and the angle of {:g} rad", opening, angle);
  if (const auto segments = explicit_segments("cap", options, {3, 1}))
    return cap_rings(radius, opening, angle, (*segments)[1], false, [&](double) { return (*segments)[0]; });
  const double length = options.edge_length;
  // room for one row of triangles, and for six edges around each rim
  double largest = std::min(radius * (angle - opening), 1.05 * radius * std::sin(angle));
  if (opening > 0.0)
    largest = std::min(largest, 1.05 * radius * std::sin(opening));
  check_edge_length("cap", length, largest, two_pi * radius * radius * (std::cos(opening) - std::cos(angle)));
  if (options.pattern == Pattern::irregular)
    return cap_irregular(radius, opening, angle, options);
  const bool equilateral = options.pattern == Pattern::equilateral;
  const double around = equilateral ? length : length / 1.09; // mean edges over edges around: measured
  const std::uint32_t rows = segments_of(radius * (angle - opening), equilateral ? row_height * length : around);
  return cap_rings(radius, opening, angle, rows, equilateral,
                   [&](double polar) { return segments_of(two_pi * radius * std::sin(polar), around, 6); });
}

TriangleMesh make_tube(double radius, double height, const MeshOptions& options) {
  check_length("tube", "radius", radius);
  check_length("tube", "height", height);
  if (const auto segments = explicit_segments("tube", options, {3, 1}))
    return tube_grid(radius, height, (*segments)[0], (*segments)[1], false);
  const double length = options.edge_length;
  check_edge_length("tube", length, std::min(height, 1.05 * radius), two_pi * radius * height);
  switch (options.pattern) {
  case Pattern::structured:
    return tube_grid(radius, height, even_segments_of(two_pi * radius, right_leg * length),
                     segments_of(height, right_leg * length), false);
  case Pattern::equilateral:
    return tube_grid(radius, height, segments_of(two_pi * radius, length, 6), segments_of(height, row_height * length),
                     true);
  case Pattern::irregular:
    break;
  }
  return tube_irregular(radius, height, options);
}

} // namespace sheet
