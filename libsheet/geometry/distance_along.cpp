// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/distance_along.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace sheet {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The distance of p, given those of a and b (infinite: not known) from a source across the edge ab.
double across(const Vector3& a, const Vector3& b, double of_a, double of_b, const Vector3& p) {
  const Vector3 side = b - a, to_p = p - a;
  const double length = side.norm(), along_p = side.dot(to_p) / length, height = side.cross(to_p).norm() / length;
  const double along = (of_a * of_a - of_b * of_b + length * length) / (2 * length);
  const double depth = std::sqrt(std::max(0.0, of_a * of_a - along * along));
  const double crossing = along + (along_p - along) * depth / (depth + height);
  if (crossing >= 0 && crossing <= length) // false where one is not known
    return std::hypot(along_p - along, depth + height);
  return std::min(of_a + to_p.norm(), of_b + (p - b).norm());
}

class Walk {
public:
  Walk(std::span<const Vector3> x, const MeshPoint& from, const MeshPoint& to, double limit)
      : x_(x), to_(to), limit_(limit) {
    for (const std::uint32_t v : from.vertices)
      offer(v, (x[v] - from.place).norm(), infinity);
  }

  // The next vertex to go on from, the nearest first; no_index: there is none.
  std::uint32_t next() {
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (distance == at(v))
        return v;
    }
    return no_index;
  }

  // From v to the other corners of a triangle of it.
  void pass(std::uint32_t v, const Corners& triangle) {
    const std::size_t i = static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), v) - triangle.begin());
    const std::uint32_t a = triangle[(i + 1) % 3], b = triangle[(i + 2) % 3];
    const double longest = std::max({(x_[a] - x_[v]).norm(), (x_[b] - x_[v]).norm(), (x_[a] - x_[b]).norm()});
    offer(a, across(x_[v], x_[b], at(v), at(b), x_[a]), longest);
    offer(b, across(x_[v], x_[a], at(v), at(a), x_[b]), longest);
  }

  [[nodiscard]] bool arrived() const {
    const std::uint32_t a = to_.vertices.front(), b = to_.vertices.back();
    return (a == b ? at(a) : across(x_[a], x_[b], at(a), at(b), to_.place)) <= limit_;
  }

private:
  [[nodiscard]] double at(std::uint32_t v) const {
    const auto found = distance_.find(v);
    return found == distance_.end() ? infinity : found->second;
  }

  // The nearer end of an edge that a way within the limit crosses lies on one that is longer by the edge at most.
  void offer(std::uint32_t v, double distance, double edge) {
    constexpr double lower = 1 - 1e-12; // what falls by rounding alone does not go round again
    if (!(distance < lower * at(v)))
      return;
    distance_[v] = distance;
    if (distance + (to_.place - x_[v]).norm() <= limit_ + edge)
      queue_.emplace(distance, v);
  }

  using Entry = std::pair<double, std::uint32_t>;
  std::span<const Vector3> x_;
  MeshPoint to_;
  double limit_;
  std::unordered_map<std::uint32_t, double> distance_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

} // namespace

DistanceAlong::DistanceAlong(const Connectivity& mesh) : mesh_(mesh), begin_(mesh.vertices + 1, 0) {
  for (const Corners& t : mesh.triangles)
    for (const std::uint32_t v : t)
      ++begin_[v + 1];
  for (std::size_t v = 0; v < mesh.vertices; ++v)
    begin_[v + 1] += begin_[v];
  around_.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> end(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      around_[end[v]++] = t;
}

bool DistanceAlong::within(std::span<const Vector3> positions, const MeshPoint& from, const MeshPoint& to,
                           double limit) const {
  Walk walk(positions, from, to, limit);
  for (std::uint32_t v = walk.next(); v != no_index; v = walk.next())
    for (std::uint32_t i = begin_[v]; i < begin_[v + 1]; ++i)
      walk.pass(v, mesh_.triangles[around_[i]]);
  return walk.arrived();
}

} // namespace sheet
