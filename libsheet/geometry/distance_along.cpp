// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/distance_along.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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
    return std::sqrt((along_p - along) * (along_p - along) + (depth + height) * (depth + height));
  return std::min(of_a + to_p.norm(), of_b + (p - b).norm());
}

// What the walks of a thread leave to the next ones: room. Between walks all distances are infinite.
struct Room {
  using Entry = std::pair<double, std::uint32_t>;
  std::vector<double> distance; // of each vertex
  std::vector<std::uint32_t> reached;
  std::vector<Entry> queue; // a heap, the nearest first
};

class Walk {
public:
  Walk(std::span<const Vector3> x, const MeshPoint& from, const MeshPoint& to, double limit, Room& room)
      : x_(x), to_(to), limit_(limit), room_(room) {
    if (room.distance.size() < x.size())
      room.distance.resize(x.size(), infinity);
    for (const std::uint32_t v : from.vertices)
      offer(v, (x[v] - from.place).norm(), infinity);
  }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;
  ~Walk() {
    for (const std::uint32_t v : room_.reached)
      room_.distance[v] = infinity;
    room_.reached.clear();
    room_.queue.clear();
  }

  // The next vertex to go on from, the nearest first; no_index: there is none.
  std::uint32_t next() {
    while (!room_.queue.empty()) {
      std::ranges::pop_heap(room_.queue, std::greater<>());
      const auto [distance, v] = room_.queue.back();
      room_.queue.pop_back();
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
  // Of a vertex, whose distance only falls, it is known as soon as it is.
  [[nodiscard]] bool arrived_for_good() const { return to_.vertices.size() == 1 && arrived(); }

private:
  [[nodiscard]] double at(std::uint32_t v) const { return room_.distance[v]; }

  // The nearer end of an edge that a way within the limit crosses lies on one that is longer by the edge at most.
  void offer(std::uint32_t v, double distance, double edge) {
    constexpr double lower = 1 - 1e-12; // what falls by rounding alone does not go round again
    if (!(distance < lower * at(v)))
      return;
    if (at(v) == infinity)
      room_.reached.push_back(v);
    room_.distance[v] = distance;
    if (distance + (to_.place - x_[v]).norm() > limit_ + edge)
      return;
    room_.queue.emplace_back(distance, v);
    std::ranges::push_heap(room_.queue, std::greater<>());
  }

  std::span<const Vector3> x_;
  MeshPoint to_;
  double limit_;
  Room& room_;
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
  thread_local Room room;
  Walk walk(positions, from, to, limit, room);
  for (std::uint32_t v = walk.next(); v != no_index && !walk.arrived_for_good(); v = walk.next())
    for (std::uint32_t i = begin_[v]; i < begin_[v + 1]; ++i)
      walk.pass(v, mesh_.triangles[around_[i]]);
  return walk.arrived();
}

} // namespace sheet
