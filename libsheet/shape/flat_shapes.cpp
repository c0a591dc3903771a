// SPDX-License-Identifier: GPL-3.0-or-later
// Rectangle, disk and annulus in the plane z = 0.
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

void append_circle(double radius, std::uint32_t count, double phase, Points& points) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = two_pi * (i + phase) / count;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
  }
}

// ---- rectangle -------------------------------------------------------------------------------------------------

TriangleMesh rectangle_grid(double lx, double ly, std::uint32_t nx, std::uint32_t ny) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i)
      mesh.positions.emplace_back(lx * (static_cast<double>(i) / nx - 0.5), ly * (static_cast<double>(j) / ny - 0.5),
                                  0.0);
  mesh.triangles = grid_triangles(nx, ny, false);
  return mesh;
}

// Rows of equilateral triangles; every second row is shifted by half an edge and has a vertex on each end besides.
TriangleMesh rectangle_rows(double lx, double ly, double edge_length) {
  const std::uint32_t nx = segments_of(lx, edge_length), ny = segments_of(ly, edge_length * row_height);
  TriangleMesh mesh;
  std::vector<std::uint32_t> first;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    first.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    const double y = ly * (static_cast<double>(j) / ny - 0.5);
    const auto add = [&](double columns) { mesh.positions.emplace_back(lx * (columns / nx - 0.5), y, 0.0); };
    if (j % 2 == 0) {
      for (std::uint32_t i = 0; i <= nx; ++i)
        add(i);
    } else {
      add(0);
      for (std::uint32_t i = 0; i < nx; ++i)
        add(i + 0.5);
      add(nx);
    }
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    const bool up = j % 2 == 0; // the row below has nx + 1 vertices, that above nx + 2
    const std::uint32_t even = first[up ? j : j + 1], odd = first[up ? j + 1 : j];
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { // as seen with the even row below
      mesh.triangles.push_back(up ? TriangleIndices{a, b, c} : TriangleIndices{a, c, b});
    };
    for (std::uint32_t i = 0; i <= nx; ++i) {
      add(even + i, odd + i + 1, odd + i);
      if (i < nx)
        add(even + i, even + i + 1, odd + i + 1);
    }
  }
  return mesh;
}

TriangleMesh rectangle_irregular(double lx, double ly, double edge_length, std::uint64_t seed) {
  const std::uint32_t nx = segments_of(lx, edge_length), ny = segments_of(ly, edge_length);
  const double hx = 0.5 * lx, hy = 0.5 * ly;
  // the fraction first: its ends are exact, so that the sides are straight to the last bit
  const auto x_at = [=](std::uint32_t i) { return lx * (static_cast<double>(i) / nx - 0.5); };
  const auto y_at = [=](std::uint32_t j) { return ly * (static_cast<double>(j) / ny - 0.5); };
  Points rim;
  for (std::uint32_t i = 0; i < nx; ++i)
    rim.emplace_back(x_at(i), -hy, 0.0);
  for (std::uint32_t j = 0; j < ny; ++j)
    rim.emplace_back(hx, y_at(j), 0.0);
  for (std::uint32_t i = nx; i > 0; --i)
    rim.emplace_back(x_at(i), hy, 0.0);
  for (std::uint32_t j = ny; j > 0; --j)
    rim.emplace_back(-hx, y_at(j), 0.0);
  ScatterSurface surface;
  surface.sample = [=](Random& random) {
    const double x = random.uniform(-hx, hx);
    return Eigen::Vector3d(x, random.uniform(-hy, hy), 0.0);
  };
  surface.rim_distance = [=](const Eigen::Vector3d& p) { return std::min(hx - std::abs(p.x()), hy - std::abs(p.y())); };
  surface.project = [](const Eigen::Vector3d& p) { return p; };
  surface.triangulate = planar_delaunay;
  surface.area = lx * ly;
  return irregular_mesh(surface, std::move(rim), edge_length, seed);
}

// ---- disk and annulus ------------------------------------------------------------------------------------------

// The ring between two radii (inner 0: a disk), rims first the inner, then the outer one.
ScatterSurface ring_surface(double inner, double outer, std::size_t inner_count) {
  ScatterSurface surface;
  surface.sample = [=](Random& random) {
    const double angle = random.uniform(0.0, two_pi);
    const double r = std::sqrt(random.uniform(inner * inner, outer * outer));
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
  };
  surface.rim_distance = [=](const Eigen::Vector3d& p) {
    const double r = p.norm();
    return std::min(outer - r, inner > 0.0 ? r - inner : std::numeric_limits<double>::infinity());
  };
  surface.project = [](const Eigen::Vector3d& p) { return p; };
  surface.triangulate = [=](const Points& points) {
    std::vector<TriangleIndices> triangles = planar_delaunay(points);
    drop_hole(triangles, inner_count);
    return triangles;
  };
  surface.area = std::numbers::pi * (outer * outer - inner * inner);
  surface.euler_characteristic = inner > 0.0 ? 0 : 1;
  return surface;
}

// A hexagonal lattice inside, whose outermost rows are relaxed towards the rims.
TriangleMesh fitted_lattice(const ScatterSurface& surface, Points points, double outer, double edge_length) {
  const std::size_t rim = points.size();
  const double step = edge_length * row_height;
  const int rows = static_cast<int>(outer / step) + 1, columns = static_cast<int>(outer / edge_length) + 1;
  for (int j = -rows; j <= rows; ++j)
    for (int i = -columns; i <= columns; ++i) {
      const Eigen::Vector3d p(edge_length * (i + (j % 2 == 0 ? 0.0 : 0.5)), step * j, 0.0);
      if (surface.rim_distance(p) > 0.55 * edge_length)
        points.push_back(p);
    }
  relax(
      surface, rim, 25, [&](const Eigen::Vector3d& p) { return surface.rim_distance(p) < 3.0 * edge_length; }, points);
  TriangleMesh mesh;
  mesh.triangles = surface.triangulate(points);
  mesh.positions = std::move(points);
  return mesh;
}

TriangleMesh round_shape(double inner, double outer, const MeshOptions& options) {
  const double length = options.edge_length;
  Points rim;
  const std::uint32_t inner_count = inner > 0.0 ? segments_of(two_pi * inner, length, 6) : 0;
  append_circle(inner, inner_count, 0.0, rim);
  append_circle(outer, segments_of(two_pi * outer, length, 6), 0.0, rim);
  const ScatterSurface surface = ring_surface(inner, outer, inner_count);
  return options.pattern == Pattern::irregular ? irregular_mesh(surface, std::move(rim), length, options.seed)
                                               : fitted_lattice(surface, std::move(rim), outer, length);
}

// Rings of 6, 12, 18, ... vertices around the centre.
TriangleMesh disk_of_six_sectors(double radius, std::uint32_t rings) {
  TriangleMesh mesh;
  mesh.positions.emplace_back(Eigen::Vector3d::Zero());
  Ring last;
  for (std::uint32_t k = 1; k <= rings; ++k) {
    const Ring ring{static_cast<std::uint32_t>(mesh.positions.size()), 6 * k};
    append_circle(radius * k / rings, ring.count, 0.0, mesh.positions);
    if (k == 1)
      fan(0, ring, mesh.triangles);
    else
      stitch_rings(mesh.positions, last, ring, mesh.triangles);
    last = ring;
  }
  return mesh;
}

// A grid in polar coordinates; around a centre the innermost ring of the grid is a fan.
TriangleMesh polar_grid(double inner, double outer, std::uint32_t around, std::uint32_t radial) {
  TriangleMesh mesh;
  const std::uint32_t start = inner > 0.0 ? 0 : 1; // a disk's first ring is its centre
  for (std::uint32_t j = start; j <= radial; ++j)
    append_circle(inner + (outer - inner) * j / radial, around, 0.0, mesh.positions);
  mesh.triangles = grid_triangles(around, radial - start, true);
  for (TriangleIndices& t : mesh.triangles) // rows go outward, to the right of a counter-clockwise row
    std::swap(t[1], t[2]);
  if (start == 1) {
    mesh.positions.emplace_back(Eigen::Vector3d::Zero());
    fan(static_cast<std::uint32_t>(mesh.positions.size() - 1), {0, around}, mesh.triangles);
  }
  return mesh;
}

} // namespace

TriangleMesh make_rectangle(double size_x, double size_y, const MeshOptions& options) {
  check_length("rectangle", "the first size", size_x);
  check_length("rectangle", "the second size", size_y);
  if (const auto segments = explicit_segments("rectangle", options, {1, 1}))
    return rectangle_grid(size_x, size_y, (*segments)[0], (*segments)[1]);
  const double length = options.edge_length;
  check_edge_length("rectangle", length, std::min(size_x, size_y), size_x * size_y);
  switch (options.pattern) {
  case Pattern::structured:
    return rectangle_grid(size_x, size_y, segments_of(size_x, right_leg * length),
                          segments_of(size_y, right_leg * length));
  case Pattern::equilateral:
    return rectangle_rows(size_x, size_y, length);
  case Pattern::irregular:
    break;
  }
  return rectangle_irregular(size_x, size_y, length, options.seed);
}

TriangleMesh make_disk(double radius, const MeshOptions& options) {
  check_length("disk", "radius", radius);
  if (const auto segments = explicit_segments("disk", options, {3, 1}))
    return polar_grid(0.0, radius, (*segments)[0], (*segments)[1]);
  check_edge_length("disk", options.edge_length, radius, std::numbers::pi * radius * radius);
  if (options.pattern == Pattern::structured) // the mean edge is 1.08 times the distance of the rings (measured)
    return disk_of_six_sectors(radius, segments_of(radius, options.edge_length / 1.08));
  return round_shape(0.0, radius, options);
}

TriangleMesh make_annulus(double inner_radius, double outer_radius, const MeshOptions& options) {
  check_length("annulus", "inner_radius", inner_radius);
  check_length("annulus", "outer_radius", outer_radius);
  if (!(inner_radius < outer_radius))
    fail(ExitCode::bad_input, "annulus: inner_radius = {:g} m must be smaller than outer_radius = {:g} m", inner_radius,
         outer_radius);
  if (const auto segments = explicit_segments("annulus", options, {3, 1}))
    return polar_grid(inner_radius, outer_radius, (*segments)[0], (*segments)[1]);
  const double length = options.edge_length, width = outer_radius - inner_radius;
  check_edge_length("annulus", length, std::min(width, 1.05 * inner_radius),
                    std::numbers::pi * (outer_radius + inner_radius) * width);
  if (options.pattern == Pattern::structured)
    return polar_grid(inner_radius, outer_radius,
                      even_segments_of(std::numbers::pi * (inner_radius + outer_radius), right_leg * length),
                      segments_of(width, right_leg * length));
  return round_shape(inner_radius, outer_radius, options);
}

} // namespace sheet
