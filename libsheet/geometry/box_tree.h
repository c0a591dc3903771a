// SPDX-License-Identifier: GPL-3.0-or-later
// Which boxes of a set overlap: a balanced tree of boxes, split at medians, so that building costs n log n whatever the
// shape, and equal input gives an equal tree for any number of threads.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "libsheet/geometry/box.h"

namespace sheet {

// A box in single precision, rounded outward: says in a few instructions that two boxes do not overlap.
struct QuickBox {
  using Four = float __attribute__((vector_size(16)));
  Four low = {3e38F, 3e38F, 3e38F, 0}, high = {-3e38F, -3e38F, -3e38F, 0};

  QuickBox() = default;
  explicit QuickBox(const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto l = static_cast<float>(box.low[axis]), h = static_cast<float>(box.high[axis]);
      low[axis] = l - (std::abs(l) * 0x1p-22F + 1e-37F);
      high[axis] = h + (std::abs(h) * 0x1p-22F + 1e-37F);
    }
  }
  void add(const QuickBox& other) {
    low = other.low < low ? other.low : low;
    high = other.high > high ? other.high : high;
  }
  // False only if the boxes surely have no point in common.
  [[nodiscard]] bool may_overlap(const QuickBox& other) const {
    using Halves = long long __attribute__((vector_size(16)));
    const auto apart = reinterpret_cast<Halves>((low > other.high) | (other.low > high));
    return (apart[0] | apart[1]) == 0;
  }
};

class BoxTree {
public:
  // Sorts the boxes by place; index i of everything below is that of boxes[i].
  void build(std::span<const Box> boxes);
  // The same boxes at new places; the order stays, which costs speed only.
  void refit(std::span<const Box> boxes);

  [[nodiscard]] std::size_t size() const { return order_.size(); }

  // Calls visit(chunk, i, j) for the overlapping pairs i != j of which at least one is in `chosen` (a flag a box;
  // empty: all), each pair once, chunk by chunk on all threads, chunks 0 to chunks() - 1. What a chunk visits, and in
  // which order, depends on the boxes alone.
  template <class Visit> void for_overlaps(std::span<const std::uint8_t> chosen, Visit&& visit) const {
    tbb::parallel_for(std::size_t{0}, chunks(), [&](std::size_t chunk) {
      const std::size_t end = std::min((chunk + 1) * leaves_of_chunk, leaves());
      for (std::size_t leaf = chunk * leaves_of_chunk; leaf < end; ++leaf)
        visit_from(first_leaf() + leaf, chosen, [&](std::uint32_t i, std::uint32_t j) { visit(chunk, i, j); });
    });
  }
  [[nodiscard]] std::size_t chunks() const { return (leaves() + leaves_of_chunk - 1) / leaves_of_chunk; }

private:
  struct Node {
    QuickBox box;
    std::uint32_t begin = 0, end = 0; // of order_
  };
  void split(std::span<const Box> boxes, std::size_t node);
  [[nodiscard]] bool is_leaf(std::size_t node) const { return 2 * node + 1 >= nodes_.size(); }
  [[nodiscard]] std::size_t leaves() const { return (nodes_.size() + 1) / 2; }
  [[nodiscard]] std::size_t first_leaf() const { return leaves() - 1; }

  // Which of a leaf's boxes are chosen, as bits.
  [[nodiscard]] unsigned chosen_in(const Node& leaf, std::span<const std::uint8_t> chosen) const {
    if (chosen.empty())
      return ~0U;
    unsigned bits = 0;
    for (std::uint32_t place = leaf.begin; place < leaf.end; ++place)
      bits |= static_cast<unsigned>(chosen[order_[place]] != 0) << (place - leaf.begin);
    return bits;
  }

  // The pairs of a leaf's boxes with those of leaves that do not stand before it; where only some boxes are chosen and
  // the leaf has such, those of all leaves: pairs of two leaves that both have such belong to the first.
  template <class Visit> void visit_from(std::size_t leaf, std::span<const std::uint8_t> chosen, Visit&& visit) const {
    const Node& own = nodes_[leaf];
    const unsigned bits = chosen_in(own, chosen);
    if (bits == 0 || own.begin == own.end)
      return;
    std::array<std::size_t, 64> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const std::size_t node = stack[--top];
      const Node& n = nodes_[node];
      if ((chosen.empty() && n.end <= own.begin) || !n.box.may_overlap(own.box))
        continue;
      if (!is_leaf(node)) {
        stack[top++] = 2 * node + 2;
        stack[top++] = 2 * node + 1;
      } else if (node >= leaf || chosen_in(n, chosen) == 0) {
        visit_leaves(own, bits, n, chosen_in(n, chosen), visit);
      }
    }
  }

  template <class Visit>
  void visit_leaves(const Node& a, unsigned bits_a, const Node& b, unsigned bits_b, Visit&& visit) const {
    for (std::uint32_t i = a.begin; i < a.end; ++i)
      for (std::uint32_t j = a.begin == b.begin ? i + 1 : b.begin; j < b.end; ++j)
        if (((bits_a >> (i - a.begin) | bits_b >> (j - b.begin)) & 1U) != 0 && quick_[i].may_overlap(quick_[j]) &&
            boxes_[i].overlaps(boxes_[j]))
          visit(order_[i], order_[j]);
  }

  static constexpr std::size_t leaves_of_chunk = 64;

  std::vector<Box> boxes_;           // in the order of the tree
  std::vector<QuickBox> quick_;      // the same
  std::vector<std::uint32_t> order_; // the box at each place
  std::vector<Node> nodes_;          // a full binary tree: the children of n are 2n+1 and 2n+2
};

} // namespace sheet
