// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libsheet/geometry/triangle_grid.h"
#include "libsheet/geometry/triangle_pair.h"

namespace sheet::flow {

namespace {

constexpr double gap = 1e-3; // of the way from a vertex to the nearest opposite side

// How a vertex moves into its fan: along the bisector of the fan's whole angle.
class Retreat {
public:
  void add(const Vector3& x, const Vector3& next, const Vector3& previous) {
    const Vector3 a = (next - x).normalized(), b = (previous - x).normalized();
    const Vector3 between = a + b;
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b)), length = between.norm();
    if (length > 0)
      bisector_ += 2 * std::sin(angle / 2) / length * between; // the integral of unit vectors over the angle
    const double opposite = (previous - next).norm();
    if (opposite > 0)
      room_ = std::min(room_, (next - x).cross(previous - x).norm() / opposite);
  }
  [[nodiscard]] Vector3 step() const {
    const double length = bisector_.norm();
    return length > 0 && std::isfinite(room_) ? Vector3(gap * room_ / length * bisector_) : Vector3::Zero();
  }

private:
  Vector3 bisector_ = Vector3::Zero();
  double room_ = std::numeric_limits<double>::infinity();
};

bool apart(const Fans& fans, std::uint32_t v) { return fans.fan_count[fans.old_vertex[v]] > 1; }

} // namespace

std::vector<Vector3> open_cracks(const Fans& fans, const std::vector<bool>& dropped, std::span<const Vector3> x) {
  const std::size_t n = fans.old_vertex.size();
  std::vector<Retreat> retreats(n);
  const auto at = [&](std::uint32_t v) { return x[fans.old_vertex[v]]; };
  for (std::size_t t = 0; t < fans.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3 && !dropped[t]; ++i) {
      const Corners& c = fans.triangles[t];
      if (apart(fans, c[i]))
        retreats[c[i]].add(at(c[i]), at(c[(i + 1) % 3]), at(c[(i + 2) % 3]));
    }
  std::vector<Vector3> opened;
  for (std::uint32_t v = 0; v < n; ++v)
    opened.push_back(apart(fans, v) ? Vector3(at(v) + retreats[v].step()) : at(v));
  return opened;
}

std::vector<bool> crossing_at(const Connectivity& mesh, std::span<const Vector3> x, const Fans& fans,
                              std::span<const Vector3> opened, const std::vector<bool>& dropped) {
  std::vector<bool> crossing(mesh.vertices, false);
  double sizes = 0;
  for (const Corners& t : fans.triangles)
    sizes += box_of(opened, t).half_size();
  const std::size_t count = fans.triangles.size();
  TriangleGrid grid(2 * sizes / static_cast<double>(count), count);
  for (std::uint32_t t = 0; t < count; ++t)
    if (!dropped[t] && !corners_collinear(opened, fans.triangles[t]) && !corners_collinear(x, mesh.triangles[t]))
      grid.add(t, box_of(opened, fans.triangles[t]));
  for (std::uint32_t t = 0; t < count; ++t) {
    const Corners& own = fans.triangles[t];
    if (!grid.has(t) || std::ranges::none_of(own, [&](std::uint32_t v) { return apart(fans, v); }))
      continue;
    bool meets = false;
    grid.for_meeting(box_of(opened, own), [&](std::uint32_t other) {
      meets = meets || (other != t && triangles_intersect(opened, own, fans.triangles[other]) &&
                        !triangles_intersect(x, mesh.triangles[t], mesh.triangles[other]));
    });
    for (const std::uint32_t v : own)
      if (meets && apart(fans, v))
        crossing[fans.old_vertex[v]] = true;
  }
  return crossing;
}

std::vector<Vector3> open_clear_cracks(const Connectivity& mesh, const Fans& fans, const std::vector<bool>& dropped,
                                       std::span<const Vector3> x) {
  constexpr int rounds = 4;
  std::vector<char> left(fans.old_vertex.size(), 0);
  for (std::size_t t = 0; t < fans.triangles.size(); ++t)
    for (const std::uint32_t v : fans.triangles[t])
      left[v] = left[v] || !dropped[t];
  std::vector<int> left_at(mesh.vertices, 0);
  for (std::size_t v = 0; v < left.size(); ++v)
    left_at[fans.old_vertex[v]] += left[v];
  std::vector<Vector3> opened = open_cracks(fans, dropped, x);
  for (int round = 0; round < rounds; ++round) {
    const std::vector<bool> crossing = crossing_at(mesh, x, fans, opened, dropped);
    if (std::ranges::none_of(crossing, [](bool c) { return c; }))
      break;
    for (std::size_t v = 0; v < opened.size(); ++v)
      if (const std::uint32_t old = fans.old_vertex[v]; crossing[old])
        opened[v] = x[old] + (left_at[old] > 1 ? 0.1 : 0) * (opened[v] - x[old]);
  }
  return opened;
}

std::size_t leave_crossing_whole(const Connectivity& mesh, std::span<const Vector3> x, const Fans& fans,
                                 std::span<const Vector3> opened, TearCuts& cuts) {
  const std::vector<bool> crossing = crossing_at(mesh, x, fans, opened, cuts.dropped);
  std::size_t taken = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto beside_dropped = [&] {
      return std::ranges::any_of(mesh.edge_triangles[e], [&](auto t) { return t != no_index && cuts.dropped[t]; });
    };
    if (!cuts.cut[e] || !(crossing[mesh.edges[e][0]] || crossing[mesh.edges[e][1]]) || beside_dropped())
      continue;
    cuts.cut[e] = false;
    --cuts.edges;
    ++taken;
  }
  return taken;
}

} // namespace sheet::flow
