// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/triangle_grid.h"

#include <algorithm>
#include <bit>

namespace sheet {

TriangleGrid::TriangleGrid(double cell, std::size_t expected)
    : cell_(cell), heads_(std::bit_ceil(std::max<std::size_t>(64, 2 * expected)), no_index) {
  items_.reserve(expected + expected / 4);
}

void TriangleGrid::add(std::uint32_t t, const Box& box) {
  if (t >= items_.size())
    items_.resize(t + 1);
  Item& item = items_[t];
  item.box = box;
  item.present = true;
  item.cell = cell_of(box.middle().array());
  reach_ = std::max(reach_, box.half_size());
  std::uint32_t& head = heads_[bucket(item.cell)];
  item.previous = no_index;
  item.next = head;
  if (head != no_index)
    items_[head].previous = t;
  head = t;
}

void TriangleGrid::remove(std::uint32_t t) {
  Item& item = items_[t];
  item.present = false;
  if (item.previous == no_index)
    heads_[bucket(item.cell)] = item.next;
  else
    items_[item.previous].next = item.next;
  if (item.next != no_index)
    items_[item.next].previous = item.previous;
}

} // namespace sheet
