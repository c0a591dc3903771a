// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles by place, for changing meshes: a hash of cells in which each triangle stands once, by the middle of its box
// [Teschner et al. 2003]. Adding and removing cost a constant time.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "libsheet/geometry/box.h"

namespace sheet {

class TriangleGrid {
public:
  // `cell`: about the size of a triangle [m]; `expected`: number of triangles.
  TriangleGrid(double cell, std::size_t expected);

  void add(std::uint32_t triangle, const Box& box);
  void remove(std::uint32_t triangle);
  [[nodiscard]] bool has(std::uint32_t triangle) const { return triangle < items_.size() && items_[triangle].present; }
  [[nodiscard]] const Box& box_of(std::uint32_t triangle) const { return items_[triangle].box; }

  // visit(triangle) for every triangle whose box meets this one; in an order that depends on the history, but is the
  // same for the same history.
  template <class Visit> void for_meeting(const Box& box, Visit visit) const {
    const Cell low = cell_of(box.low.array() - reach_), high = cell_of(box.high.array() + reach_);
    if (cells_between(low, high) > static_cast<double>(items_.size())) {
      for (std::uint32_t t = 0; t < items_.size(); ++t)
        if (items_[t].present && items_[t].box.overlaps(box))
          visit(t);
      return;
    }
    for (std::int64_t x = low.x; x <= high.x; ++x)
      for (std::int64_t y = low.y; y <= high.y; ++y)
        for (std::int64_t z = low.z; z <= high.z; ++z) {
          const Cell cell{x, y, z};
          for (std::uint32_t t = heads_[bucket(cell)]; t != no_index; t = items_[t].next)
            if (items_[t].cell == cell && items_[t].box.overlaps(box))
              visit(t);
        }
  }

private:
  struct Cell {
    std::int64_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct Item {
    Box box;
    Cell cell;
    std::uint32_t next = no_index, previous = no_index;
    bool present = false;
  };
  static double cells_between(const Cell& low, const Cell& high) {
    const auto count = [](std::int64_t from, std::int64_t to) { return static_cast<double>(to - from + 1); };
    return count(low.x, high.x) * count(low.y, high.y) * count(low.z, high.z);
  }
  [[nodiscard]] Cell cell_of(const Eigen::Array3d& x) const {
    // far out, all share the last cell
    const auto number = [&](double c) {
      return static_cast<std::int64_t>(std::clamp(std::floor(c / cell_), -1e12, 1e12));
    };
    return {number(x[0]), number(x[1]), number(x[2])};
  }
  [[nodiscard]] std::size_t bucket(const Cell& c) const {
    const auto hash = static_cast<std::uint64_t>(c.x) * 73856093U ^ static_cast<std::uint64_t>(c.y) * 19349663U ^
                      static_cast<std::uint64_t>(c.z) * 83492791U;
    return hash & (heads_.size() - 1);
  }
  double cell_, reach_ = 0; // reach: the largest half size of a box so far
  std::vector<std::uint32_t> heads_;
  std::vector<Item> items_;
};

} // namespace sheet
