// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/box_tree.h"

#include <algorithm>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_invoke.h>

namespace sheet {

namespace {

constexpr std::size_t boxes_of_leaf = 4;
constexpr std::uint32_t boxes_worth_a_task = 4096;

} // namespace

void BoxTree::build(std::span<const Box> boxes) {
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::size_t leaves = 1;
  while (leaves * boxes_of_leaf < boxes.size())
    leaves *= 2;
  nodes_.assign(2 * leaves - 1, {});
  nodes_[0].end = static_cast<std::uint32_t>(boxes.size());
  split(boxes, 0);
  refit(boxes);
}

void BoxTree::split(std::span<const Box> boxes, std::size_t node) {
  if (is_leaf(node))
    return;
  const Node& n = nodes_[node];
  const auto middle_of = [&](std::uint32_t i) -> Vector3 { return boxes[i].low + boxes[i].high; };
  Box centers;
  for (std::uint32_t place = n.begin; place < n.end; ++place)
    centers.add(middle_of(order_[place]), 0);
  Eigen::Index axis = 0;
  (centers.high - centers.low).maxCoeff(&axis);
  const std::uint32_t half = n.begin + (n.end - n.begin) / 2;
  std::nth_element(order_.begin() + n.begin, order_.begin() + half, order_.begin() + n.end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double at_a = boxes[a].low[axis] + boxes[a].high[axis];
                     const double at_b = boxes[b].low[axis] + boxes[b].high[axis];
                     return at_a < at_b || (at_a == at_b && a < b);
                   });
  const std::size_t left = 2 * node + 1, right = left + 1;
  nodes_[left].begin = n.begin;
  nodes_[left].end = nodes_[right].begin = half;
  nodes_[right].end = n.end;
  if (n.end - n.begin < boxes_worth_a_task) {
    split(boxes, left);
    split(boxes, right);
  } else {
    tbb::parallel_invoke([&] { split(boxes, left); }, [&] { split(boxes, right); });
  }
}

void BoxTree::refit(std::span<const Box> boxes) {
  boxes_.resize(boxes.size());
  quick_.resize(boxes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order_.size(), 1024), [&](const auto& range) {
    for (std::size_t place = range.begin(); place < range.end(); ++place) {
      boxes_[place] = boxes[order_[place]];
      quick_[place] = QuickBox(boxes_[place]);
    }
  });
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    Node& n = nodes_[node];
    n.box = {};
    if (is_leaf(node)) {
      for (std::uint32_t place = n.begin; place < n.end; ++place)
        n.box.add(quick_[place]);
    } else {
      n.box.add(nodes_[2 * node + 1].box);
      n.box.add(nodes_[2 * node + 2].box);
    }
  }
}

} // namespace sheet
