// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/box_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace sheet::collide {

namespace {

constexpr std::size_t boxes_of_leaf = 4;
constexpr std::size_t places_of_chunk = 256;
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
  for (std::size_t place = 0; place < order_.size(); ++place)
    boxes_[place] = boxes[order_[place]];
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    Node& n = nodes_[node];
    n.box = {};
    if (is_leaf(node)) {
      for (std::uint32_t place = n.begin; place < n.end; ++place)
        n.box.add(boxes_[place]);
    } else {
      n.box.add(nodes_[2 * node + 1].box);
      n.box.add(nodes_[2 * node + 2].box);
    }
  }
}

std::size_t BoxTree::chunks() const { return (order_.size() + places_of_chunk - 1) / places_of_chunk; }

void BoxTree::for_overlaps(std::span<const std::uint8_t> chosen,
                           const std::function<void(std::size_t, std::uint32_t, std::uint32_t)>& visit) const {
  tbb::parallel_for(std::size_t{0}, chunks(), [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * places_of_chunk, order_.size());
    for (std::size_t place = chunk * places_of_chunk; place < end; ++place)
      if (chosen.empty() || chosen[order_[place]] != 0)
        visit_from(static_cast<std::uint32_t>(place), chosen, chunk, visit);
  });
}

void BoxTree::visit_from(std::uint32_t place, std::span<const std::uint8_t> chosen, std::size_t chunk,
                         const std::function<void(std::size_t, std::uint32_t, std::uint32_t)>& visit) const {
  const Box& box = boxes_[place];
  std::array<std::size_t, 64> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::size_t node = stack[--top];
    const Node& n = nodes_[node];
    // pairs of two chosen boxes are met twice: the one that stands first reports
    if ((chosen.empty() && n.end <= place + 1) || !n.box.overlaps(box))
      continue;
    if (!is_leaf(node)) {
      stack[top++] = 2 * node + 2;
      stack[top++] = 2 * node + 1;
      continue;
    }
    for (std::uint32_t other = n.begin; other < n.end; ++other) {
      const bool both = chosen.empty() || chosen[order_[other]] != 0;
      if (other != place && (!both || other > place) && boxes_[other].overlaps(box))
        visit(chunk, order_[place], order_[other]);
    }
  }
}

} // namespace sheet::collide
