// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/box_tree.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_invoke.h>

namespace sheet {

namespace {

constexpr std::size_t boxes_worth_a_task = 4096;

} // namespace

void BoxTree::build(std::span<const QuickBox> boxes) {
  std::size_t leaves = 1;
  while (leaves * BoxLanes::count < boxes.size())
    leaves *= 2;
  nodes_.assign(2 * leaves - 1, {});
  leaves_.assign(leaves, {});
  order_.resize(boxes.size());
  std::vector<Place> places(boxes.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const QuickBox::Four middle = 0.5F * boxes[i].low + 0.5F * boxes[i].high;
    places[i] = {{middle[0], middle[1], middle[2]}, i};
  }
  split(places, 0);
  std::uint32_t begin = 0;
  for (Leaf& leaf : leaves_) {
    leaf.begin = begin;
    begin = leaf.end += begin;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    order_[i] = places[i].index;
  refit(boxes);
}

// Sorts what is below the node; leaves get their number in place of their end.
void BoxTree::split(std::span<Place> places, std::size_t node) {
  if (node + 1 >= leaves()) {
    leaves_[node + 1 - leaves()].end = static_cast<std::uint32_t>(places.size());
    return;
  }
  std::array<float, 3> low, high, size;
  low.fill(3e38F);
  high.fill(-3e38F);
  for (const Place& place : places)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], place.middle[axis]);
      high[axis] = std::max(high[axis], place.middle[axis]);
    }
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[axis] = high[axis] - low[axis];
  const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const auto half = static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), places.begin() + half, places.end(), [axis](const Place& a, const Place& b) {
    return a.middle[axis] < b.middle[axis] || (a.middle[axis] == b.middle[axis] && a.index < b.index);
  });
  const auto left = [&] { split(places.first(static_cast<std::size_t>(half)), 2 * node + 1); };
  const auto right = [&] { split(places.subspan(static_cast<std::size_t>(half)), 2 * node + 2); };
  if (places.size() < boxes_worth_a_task) {
    left();
    right();
  } else {
    tbb::parallel_invoke(left, right);
  }
}

void BoxTree::refit(std::span<const QuickBox> boxes) {
  const std::size_t first_leaf = leaves() - 1;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves(), 128), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      Leaf& leaf = leaves_[k];
      nodes_[first_leaf + k] = {};
      for (std::uint32_t place = leaf.begin; place < leaf.end; ++place) {
        leaf.boxes.put(place - leaf.begin, boxes[order_[place]]);
        nodes_[first_leaf + k].add(boxes[order_[place]]);
      }
    }
  });
  for (std::size_t node = first_leaf; node-- > 0;) {
    nodes_[node] = nodes_[2 * node + 1];
    nodes_[node].add(nodes_[2 * node + 2]);
  }
}

} // namespace sheet
