// SPDX-License-Identifier: GPL-3.0-or-later
// Which boxes of a set overlap: a balanced tree of boxes, split at medians, so that building costs n log n whatever the
// shape, and equal input gives an equal tree for any number of threads.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "libsheet/geometry/types.h"

namespace sheet::collide {

struct Box {
  Vector3 low = Vector3::Constant(1e300), high = Vector3::Constant(-1e300);

  void add(const Vector3& x, double margin) {
    low = low.cwiseMin((x.array() - margin).matrix());
    high = high.cwiseMax((x.array() + margin).matrix());
  }
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

class BoxTree {
public:
  // Sorts the boxes by place; index i of everything below is that of boxes[i].
  void build(std::span<const Box> boxes);
  // The same boxes at new places; the order stays, which costs speed only.
  void refit(std::span<const Box> boxes);

  [[nodiscard]] std::size_t size() const { return order_.size(); }

  // Calls visit(i, j) for the overlapping pairs i != j of which at least one is in `chosen` (a flag a box; empty: all),
  // each pair once, chunk by chunk on all threads: visit(chunk, i, j), chunks 0 to chunks() - 1. What a chunk visits,
  // and in which order, depends on the boxes alone.
  void for_overlaps(std::span<const std::uint8_t> chosen,
                    const std::function<void(std::size_t, std::uint32_t, std::uint32_t)>& visit) const;
  [[nodiscard]] std::size_t chunks() const;

private:
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0; // of order_
  };
  void split(std::span<const Box> boxes, std::size_t node);
  [[nodiscard]] bool is_leaf(std::size_t node) const { return 2 * node + 1 >= nodes_.size(); }
  void visit_from(std::uint32_t place, std::span<const std::uint8_t> chosen, std::size_t chunk,
                  const std::function<void(std::size_t, std::uint32_t, std::uint32_t)>& visit) const;

  std::vector<Box> boxes_;           // in the order of the tree
  std::vector<std::uint32_t> order_; // the box at each place
  std::vector<Node> nodes_;          // a full binary tree: the children of n are 2n+1 and 2n+2
};

} // namespace sheet::collide
