// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include <Eigen/Geometry>

#include "libsheet/base/error.h"
#include "libsheet/geometry/types.h"
#include "libsheet/shape/mesh_measure.h"

namespace sheet {

namespace {

constexpr double rim_gap = 0.6; // free points stay that many edge lengths off the rims, so that rims are Delaunay edges
constexpr int relax_rounds = 12; // enough for good angles, too few for a lattice to grow
constexpr double good_angle = 26.5 * std::numbers::pi / 180.0;

// Points in cubes of a given size, to find those near a place.
class NearbyPoints {
public:
  explicit NearbyPoints(double cube) : cube_(cube) {}

  void add(const Eigen::Vector3d& point) {
    const auto [place, is_new] = first_.try_emplace(key(cell(point)), no_index);
    next_.push_back(place->second);
    place->second = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
  }

  // Is a point nearer than `distance`, which must not exceed the cubes' size?
  [[nodiscard]] bool any_within(const Eigen::Vector3d& point, double distance) const {
    const Cell c = cell(point);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const auto place = first_.find(key({c[0] + dx, c[1] + dy, c[2] + dz}));
          for (std::uint32_t i = place == first_.end() ? no_index : place->second; i != no_index; i = next_[i])
            if ((points_[i] - point).squaredNorm() < distance * distance)
              return true;
        }
    return false;
  }

private:
  using Cell = std::array<std::int64_t, 3>;

  [[nodiscard]] Cell cell(const Eigen::Vector3d& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x() / cube_)), static_cast<std::int64_t>(std::floor(p.y() / cube_)),
            static_cast<std::int64_t>(std::floor(p.z() / cube_))};
  }
  static std::uint64_t key(const Cell& c) { // 21 bits each: unique up to a million cubes either way
    std::uint64_t k = 0;
    for (const std::int64_t x : c)
      k = k << 21 | (static_cast<std::uint64_t>(x) & 0x1FFFFFU);
    return k;
  }

  double cube_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
  Points points_;
};

// One round of repair: at every bad triangle whose surroundings are still untouched, an edge much too short loses a
// vertex, an edge much too long gets one. Returns the number of bad triangles.
std::size_t repair(const ScatterSurface& surface, std::size_t fixed, double edge_length, Points& points) {
  const std::vector<TriangleIndices> triangles = surface.triangulate(points);
  std::vector<char> touched(points.size(), 0);
  std::vector<char> removed(points.size(), 0);
  Points added;
  std::size_t bad = 0;
  for (const TriangleIndices& t : triangles) {
    if (smallest_angle(points[t[0]], points[t[1]], points[t[2]]) >= good_angle)
      continue;
    ++bad;
    if (touched[t[0]] || touched[t[1]] || touched[t[2]])
      continue;
    int shortest = 0, longest = 0;
    std::array<double, 3> length{};
    for (int k = 0; k < 3; ++k) { // edge k lies opposite corner k
      length[k] = (points[t[(k + 1) % 3]] - points[t[(k + 2) % 3]]).norm();
      shortest = length[k] < length[shortest] ? k : shortest;
      longest = length[k] > length[longest] ? k : longest;
    }
    const std::uint32_t a = t[(shortest + 1) % 3], b = t[(shortest + 2) % 3];
    const std::uint32_t victim = std::max(a, b);
    const bool too_dense = length[shortest] * length[longest] < edge_length * edge_length;
    if (too_dense && victim >= fixed) {
      removed[victim] = 1;
    } else {
      const Eigen::Vector3d middle =
          surface.project(0.5 * (points[t[(longest + 1) % 3]] + points[t[(longest + 2) % 3]]));
      if (surface.rim_distance(middle) < 0.5 * rim_gap * edge_length) {
        if (t[longest] >= fixed)
          removed[t[longest]] = 1;
      } else {
        added.push_back(middle);
      }
    }
    for (const std::uint32_t v : t)
      touched[v] = 1;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!removed[i])
      points[kept++] = points[i];
  points.resize(kept);
  points.insert(points.end(), added.begin(), added.end());
  return bad;
}

} // namespace

std::size_t free_vertex_count(const ScatterSurface& surface, std::size_t rim_vertices, double edge_length) {
  // An irregular mesh's mean edge is 1.015 times that of equilateral triangles of the same area (measured).
  const double equilateral_edge = edge_length / 1.015;
  const double triangles = surface.area / (0.25 * std::numbers::sqrt3 * equilateral_edge * equilateral_edge);
  // Euler: triangles = 2 (free vertices) + (rim vertices) - 2 (characteristic)
  const double count =
      0.5 * (triangles - static_cast<double>(rim_vertices)) + static_cast<double>(surface.euler_characteristic);
  return count > 0.0 ? static_cast<std::size_t>(std::lround(count)) : 0;
}

void scatter(const ScatterSurface& surface, std::size_t count, double edge_length, Random& random, Points& points) {
  constexpr double widest = 0.8, shrink = 0.96;
  constexpr int tries = 4; // per point, before the disc shrinks
  NearbyPoints nearby(widest * edge_length);
  for (const Eigen::Vector3d& point : points)
    nearby.add(point);
  std::size_t missing = count;
  for (double distance = widest * edge_length; missing > 0 && distance > 0.05 * edge_length; distance *= shrink)
    for (std::size_t i = tries * count; i > 0 && missing > 0; --i) {
      const Eigen::Vector3d point = surface.sample(random);
      if (surface.rim_distance(point) < rim_gap * edge_length || nearby.any_within(point, distance))
        continue;
      nearby.add(point);
      points.push_back(point);
      --missing;
    }
}

void relax(const ScatterSurface& surface, std::size_t fixed, int rounds,
           const std::function<bool(const Eigen::Vector3d&)>& may_move, Points& points) {
  for (int round = 0; round < rounds; ++round) {
    const std::vector<TriangleIndices> triangles = surface.triangulate(points);
    Points sum(points.size(), Eigen::Vector3d::Zero());
    std::vector<double> weight(points.size(), 0.0);
    for (const TriangleIndices& t : triangles) {
      const Eigen::Vector3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
      const double area = 0.5 * (b - a).cross(c - a).norm();
      for (const std::uint32_t v : t) {
        sum[v] += area / 3.0 * (a + b + c);
        weight[v] += area;
      }
    }
    for (std::size_t i = fixed; i < points.size(); ++i)
      if (weight[i] > 0.0 && may_move(points[i]))
        points[i] = surface.project(sum[i] / weight[i]);
  }
}

TriangleMesh irregular_mesh(const ScatterSurface& surface, Points fixed, double edge_length, std::uint64_t seed) {
  constexpr int most_repairs = 80;
  Random random(seed);
  const std::size_t rim = fixed.size();
  Points points = std::move(fixed);
  scatter(surface, free_vertex_count(surface, rim, edge_length), edge_length, random, points);
  const auto everywhere = [](const Eigen::Vector3d&) { return true; };
  relax(surface, rim, relax_rounds, everywhere, points);
  std::size_t bad = 1;
  for (int i = 0; i < most_repairs && (bad = repair(surface, rim, edge_length, points)) > 0; ++i)
    relax(surface, rim, 2, everywhere, points);
  if (bad > 0)
    fail(ExitCode::bad_input,
         "the irregular pattern finds no good triangles at edge_length = {:g} m (seed {}): the shape is only a few "
         "edges wide; use a smaller edge_length, another seed or another pattern",
         edge_length, seed);
  TriangleMesh mesh;
  mesh.triangles = surface.triangulate(points);
  mesh.positions = std::move(points);
  return mesh;
}

} // namespace sheet
