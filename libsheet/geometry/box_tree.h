// SPDX-License-Identifier: GPL-3.0-or-later
// Which boxes of a set overlap: a balanced tree of boxes, split at medians, so that building costs n log n whatever the
// shape, and equal input gives an equal tree for any number of threads. Its leaves have up to eight boxes side by side,
// which are compared at once.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "libsheet/geometry/box_lanes.h"

namespace sheet {

class BoxTree {
public:
  // Sorts the boxes by place; index i of everything below is that of boxes[i].
  void build(std::span<const QuickBox> boxes);
  // The same boxes at new places; the order stays, which costs speed only.
  void refit(std::span<const QuickBox> boxes);

  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] std::size_t leaves() const { return leaves_.size(); }

  // The boxes of a leaf, and the index of each.
  [[nodiscard]] const BoxLanes& boxes(std::size_t leaf) const { return leaves_[leaf].boxes; }
  [[nodiscard]] const QuickBox& around(std::size_t leaf) const { return nodes_[leaves() - 1 + leaf]; }
  [[nodiscard]] std::span<const std::uint32_t> indices(std::size_t leaf) const {
    return std::span(order_).subspan(leaves_[leaf].begin, leaves_[leaf].end - leaves_[leaf].begin);
  }

  // Which of a leaf's boxes are in `chosen` (a flag a box; empty: all), as bits.
  [[nodiscard]] unsigned chosen_in(std::size_t leaf, std::span<const std::uint8_t> chosen) const {
    if (chosen.empty())
      return ~0U;
    unsigned bits = 0, lane = 0;
    for (const std::uint32_t i : indices(leaf))
      bits |= static_cast<unsigned>(chosen[i] != 0) << lane++;
    return bits;
  }

  // Calls visit(chunk, a, b) for the leaves a and b whose boxes may overlap and of which at least one has a box in
  // `chosen` (a flag a box; empty: all), each pair once, and each leaf with itself; those of a come one after the
  // other. Chunk by chunk on all threads, chunks 0 to chunks() - 1; what a chunk visits, and in which order, depends on
  // the boxes alone.
  template <class Visit> void for_leaves(std::span<const std::uint8_t> chosen, Visit&& visit) const {
    tbb::parallel_for(std::size_t{0}, chunks(), [&](std::size_t chunk) {
      const std::size_t end = std::min((chunk + 1) * leaves_of_chunk, leaves());
      for (std::size_t leaf = chunk * leaves_of_chunk; leaf < end; ++leaf)
        visit_from(leaf, chosen, [&](std::size_t other) { visit(chunk, leaf, other); });
    });
  }

  // Calls visit(chunk, i, j) for the pairs i != j that may overlap and of which at least one is chosen, each pair once.
  template <class Visit> void for_overlaps(std::span<const std::uint8_t> chosen, Visit&& visit) const {
    for_leaves(chosen, [&](std::size_t chunk, std::size_t a, std::size_t b) {
      const Leaf &of_a = leaves_[a], &of_b = leaves_[b];
      const unsigned chosen_a = chosen_in(a, chosen), chosen_b = chosen_in(b, chosen);
      for (std::uint32_t i = of_a.begin; i < of_a.end; ++i) {
        const std::uint32_t lane = i - of_a.begin;
        unsigned bits = of_b.boxes.may_overlap(of_a.boxes[lane]) & ((chosen_a >> lane & 1U) != 0 ? ~0U : chosen_b);
        if (a == b)
          bits &= ~1U << lane; // those behind it
        for (; bits != 0; bits &= bits - 1)
          visit(chunk, order_[i], order_[of_b.begin + static_cast<std::uint32_t>(std::countr_zero(bits))]);
      }
    });
  }
  [[nodiscard]] std::size_t chunks() const { return (leaves() + leaves_of_chunk - 1) / leaves_of_chunk; }

private:
  struct Leaf {
    BoxLanes boxes;
    std::uint32_t begin = 0, end = 0; // of order_
  };
  struct Place { // a box to be sorted
    std::array<float, 3> middle;
    std::uint32_t index;
  };
  void split(std::span<Place> places, std::size_t node);

  // The leaf itself and those behind it; where only some boxes are chosen and the leaf has such, those before it, too,
  // that have none.
  template <class Visit> void visit_from(std::size_t leaf, std::span<const std::uint8_t> chosen, Visit&& visit) const {
    if (chosen_in(leaf, chosen) == 0 || leaves_[leaf].begin == leaves_[leaf].end)
      return;
    visit(leaf);
    const std::size_t first_leaf = leaves() - 1;
    const QuickBox own = nodes_[first_leaf + leaf];
    std::array<std::size_t, 128> stack;
    std::size_t top = 0;
    for (std::size_t node = first_leaf + leaf; node > 0; node = (node - 1) / 2)
      if (const bool left = node % 2 == 1; left || !chosen.empty())
        stack[top++] = left ? node + 1 : node - 1;
    while (top > 0) {
      const std::size_t node = stack[--top];
      if (!nodes_[node].may_overlap(own))
        continue;
      if (node < first_leaf) {
        stack[top++] = 2 * node + 2;
        stack[top++] = 2 * node + 1;
      } else if (const std::size_t other = node - first_leaf; other > leaf || chosen_in(other, chosen) == 0) {
        visit(other);
      }
    }
  }

  static constexpr std::size_t leaves_of_chunk = 32;

  std::vector<std::uint32_t> order_; // the box at each place
  std::vector<QuickBox> nodes_;      // a full binary tree: the children of n are 2n+1 and 2n+2
  std::vector<Leaf> leaves_;         // the nodes from leaves() - 1 on
};

} // namespace sheet
