// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets of the numbers 0 ... n - 1, joined step by step [Galler, Fischer 1964].
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sheet {

// The representative of a set is its smallest member.
class DisjointSets {
public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::uint64_t{0});
  }
  std::uint64_t find(std::uint64_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint64_t a, std::uint64_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  // The representative of each number.
  std::vector<std::uint64_t> take() {
    for (std::uint64_t i = 0; i < parent_.size(); ++i)
      parent_[i] = find(i);
    return std::move(parent_);
  }

private:
  std::vector<std::uint64_t> parent_;
};

} // namespace sheet
