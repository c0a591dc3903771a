// SPDX-License-Identifier: GPL-3.0-or-later
// A sheet's straight path through one step, and solids for it to meet. Users link sheet_collide.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libsheet/collide/step_path.h"
#include "libsheet/solid/mesh.h"
#include "libsheet/solid/solids.h"
#include "tests/support/meshes.h"

namespace sheet::test {

// Owns what its path refers to.
struct FallingSheet {
  std::vector<Vector3> start;
  std::vector<Corners> triangles;
  collide::StepPath path;

  // A square sheet around the y axis at this height, n cells along a side, all of it at one velocity.
  FallingSheet(double side, int n, double thickness, double height, const Vector3& velocity, double dt) {
    const Mesh mesh = rectangle(side, side, n, n, 0.2);
    for (const Vector3& x : mesh.positions)
      start.emplace_back(x.x() - side / 2, height, side / 2 - x.y());
    for (const auto& t : mesh.triangles)
      triangles.push_back({t[0], t[1], t[2]});
    path.end_time = dt;
    path.thickness.assign(start.size(), thickness);
    path.mass.assign(start.size(), 0.0);
    for (const Corners& t : triangles)
      for (const std::uint32_t v : t)
        path.mass[v] += thickness / 6 * (start[t[1]] - start[t[0]]).cross(start[t[2]] - start[t[0]]).norm();
    path.touch.assign(start.size(), no_solid);
    path.fixed.assign(start.size(), 0);
    path.velocity.assign(start.size(), velocity);
    path.triangles = triangles;
    path.start = start;
    for (const Vector3& x : start)
      path.end.push_back(x + dt * velocity);
  }
  FallingSheet(const FallingSheet&) = delete;
  FallingSheet& operator=(const FallingSheet&) = delete;

  // The next step starts where this one ended, and goes on at the velocities it ended with; holds nobody but what
  // touches.
  void go_on() {
    const double dt = path.length();
    std::ranges::copy(path.end, start.begin());
    path.start_time = path.end_time;
    path.end_time += dt;
    for (std::size_t v = 0; v < start.size(); ++v) {
      path.end[v] = start[v] + dt * path.velocity[v];
      path.fixed[v] = 0;
    }
  }
};

// The least signed distance over a triangle, to within `spacing`: parts that cannot hide anything less are passed over,
// since the distance changes no faster than 1.
inline void lower_to_least(const solid::SolidDistance& shape, const solid::Triangle3& x, double spacing,
                           double& least) {
  const Vector3 center = (x[0] + x[1] + x[2]) / 3;
  const double size = std::max({(x[0] - center).norm(), (x[1] - center).norm(), (x[2] - center).norm()});
  const double enough = std::max(1e-12, std::abs(least) + size);
  const double distance = shape.distance(center, enough);
  least = std::min(least, distance);
  if (distance - size >= least || size <= spacing)
    return;
  const Vector3 ab = (x[0] + x[1]) / 2, bc = (x[1] + x[2]) / 2, ca = (x[2] + x[0]) / 2;
  lower_to_least(shape, {ab, bc, ca}, spacing, least);
  lower_to_least(shape, {x[0], ab, ca}, spacing, least);
  lower_to_least(shape, {ab, x[1], bc}, spacing, least);
  lower_to_least(shape, {ca, bc, x[2]}, spacing, least);
}

// The least signed distance of the sheet from a solid while its vertices go straight from start to end [m], at
// `times` + 1 times. Independent of the sweeps under test.
inline double least_distance(const collide::StepPath& path, const solid::Solids& solids, std::size_t solid,
                             double spacing, int times) {
  double least = 1e3;
  for (int k = times; k >= 0; --k) {
    const double s = static_cast<double>(k) / times;
    const Eigen::Isometry3d own = solids.pose(solid, path.start_time + s * path.length()).inverse();
    for (const Corners& corners : path.triangles) {
      solid::Triangle3 x;
      for (std::size_t c = 0; c < 3; ++c)
        x[c] = own * ((1 - s) * path.start[corners[c]] + s * path.end[corners[c]]);
      lower_to_least(solids.shape(solid), x, spacing, least);
    }
  }
  return least;
}

// A pyramid of many sides that stands on y = 0 with its tip at the height: a needle where it is slender.
inline solid::SolidSurface needle(double radius, double height, std::uint32_t sides) {
  solid::SolidSurface surface;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    surface.points.emplace_back(radius * std::cos(angle), 0, radius * std::sin(angle));
  }
  surface.points.emplace_back(0, 0, 0);
  surface.points.emplace_back(0, height, 0);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    surface.triangles.push_back({i, next, sides});
    surface.triangles.push_back({next, i, sides + 1});
  }
  return surface;
}

} // namespace sheet::test
