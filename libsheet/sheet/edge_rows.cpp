// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/edge_rows.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "libsheet/sheet/transfer.h"

namespace sheet {

using Eigen::Vector3d;
using formats::Array;
using formats::Frame;
using formats::Place;

namespace {

// Middles of the edges, in the order of formats/sheet.md, section 5.
std::vector<Vector3d> middles_of(const Frame& frame) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Corners& t : triangles(frame))
    for (std::size_t i = 0; i < 3; ++i)
      edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto x = positions(frame);
  std::vector<Vector3d> middles;
  for (const auto& [a, b] : edges)
    middles.push_back((x[a] + x[b]) / 2);
  return middles;
}

// Nearest of fixed points; the first of them if several. A k-d tree in one array [Bentley 1975].
class Nearest {
public:
  explicit Nearest(std::span<const Vector3d> points) : points_(points), order_(points.size()) {
    for (std::uint32_t i = 0; i < order_.size(); ++i)
      order_[i] = i;
    build(0, order_.size(), 0);
  }
  [[nodiscard]] std::uint32_t of(const Vector3d& x) const {
    Best best{std::numeric_limits<double>::infinity(), 0};
    search(x, 0, order_.size(), 0, best);
    return best.point;
  }

private:
  struct Best {
    double distance; // squared
    std::uint32_t point;
  };
  void build(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2)
      return;
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
    });
    build(begin, middle, (axis + 1) % 3);
    build(middle + 1, end, (axis + 1) % 3);
  }
  void search(const Vector3d& x, std::size_t begin, std::size_t end, int axis, Best& best) const {
    if (begin == end)
      return;
    const std::size_t middle = (begin + end) / 2;
    const std::uint32_t point = order_[middle];
    const double distance = (points_[point] - x).squaredNorm();
    if (std::pair(distance, point) < std::pair(best.distance, best.point))
      best = {distance, point};
    const double side = x[axis] - points_[point][axis];
    const bool below = side < 0;
    search(x, below ? begin : middle + 1, below ? middle : end, (axis + 1) % 3, best);
    if (side * side <= best.distance)
      search(x, below ? middle + 1 : begin, below ? end : middle, (axis + 1) % 3, best);
  }
  std::span<const Vector3d> points_;
  std::vector<std::uint32_t> order_;
};

Lineage lineage_of(std::span<const Vector3d> old_middles, std::span<const Vector3d> new_middles) {
  const Nearest old_edges(old_middles), new_edges(new_middles);
  std::vector<std::uint32_t> parent;
  std::vector<double> children(old_middles.size());
  for (const Vector3d& middle : new_middles) {
    parent.push_back(old_edges.of(middle));
    children[parent.back()] += 1;
  }
  std::vector<std::vector<Parent>> parents(new_middles.size());
  for (std::size_t i = 0; i < parents.size(); ++i)
    parents[i].push_back({parent[i], 1, 1 / children[parent[i]]});
  for (std::uint32_t old = 0; old < children.size(); ++old)
    if (children[old] == 0)
      parents[new_edges.of(old_middles[old])].push_back({old, 0, 1});
  Lineage lineage;
  for (const auto& row : parents)
    lineage.add(row);
  return lineage;
}

} // namespace

EdgeRows::EdgeRows(const Frame& frame) {
  for (const Array& array : frame.arrays)
    if (array.place == Place::edge && array.transfer != formats::Transfer::drop)
      arrays_.push_back(array);
  if (!arrays_.empty())
    middles_ = middles_of(frame);
}

void EdgeRows::put(Frame& frame) const {
  std::erase_if(frame.arrays, [](const Array& array) {
    return array.place == Place::edge && array.transfer == formats::Transfer::drop;
  });
  frame.edges = 0;
  if (arrays_.empty())
    return;
  const std::vector<Vector3d> middles = middles_of(frame);
  if (middles.empty() || middles_.empty()) {
    std::erase_if(frame.arrays, [](const Array& array) { return array.place == Place::edge; });
    return;
  }
  frame.edges = middles.size();
  const Lineage lineage = lineage_of(middles_, middles);
  for (const Array& old : arrays_)
    frame.put(transferred(old, lineage));
}

} // namespace sheet
