// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/sheet/transfer.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "libsheet/sheet/carried_springs.h"
#include "libsheet/sheet/edge_rows.h"

namespace sheet {

using formats::Array;
using formats::Frame;
using formats::Place;
using formats::Transfer;
using formats::Type;

namespace {

const std::byte* row_of(const Array& array, std::uint32_t row) {
  const std::size_t size = formats::size_of(array.type) * array.components;
  return array.data.data() + row * size;
}

void copy_row(const Array& from, std::span<const Parent> parents, std::byte* to) {
  const Parent* best = &parents[0];
  for (const Parent& p : parents)
    if (p.weight > best->weight)
      best = &p;
  std::memcpy(to, row_of(from, best->row), formats::size_of(from.type) * from.components);
}

template <class T>
void sum_row(const Array& from, std::span<const Parent> parents, double Parent::*factor, std::byte* to) {
  for (std::uint32_t c = 0; c < from.components; ++c) {
    double sum = 0;
    for (const Parent& p : parents) {
      T value;
      std::memcpy(&value, row_of(from, p.row) + c * sizeof(T), sizeof(T));
      sum += p.*factor * static_cast<double>(value);
    }
    const T result = static_cast<T>(sum);
    std::memcpy(to + c * sizeof(T), &result, sizeof(T));
  }
}

void sum_row(const Array& from, std::span<const Parent> parents, double Parent::*factor, std::byte* to) {
  if (from.type == Type::float64)
    sum_row<double>(from, parents, factor, to);
  else
    sum_row<float>(from, parents, factor, to);
}

void common_row(const Array& from, std::span<const Parent> parents, std::byte* to) {
  const std::size_t size = formats::size_of(from.type) * from.components;
  std::fill_n(to, size, std::byte{0xff});
  for (const Parent& p : parents) {
    if (p.weight == 0)
      continue;
    const std::byte* other = row_of(from, p.row);
    for (std::size_t i = 0; i < size; ++i)
      to[i] &= other[i];
  }
}

// The new vertex that has the largest share of each old one.
std::vector<std::uint32_t> successors(const Lineage& vertices, std::size_t old_count) {
  std::vector<std::uint32_t> successor(old_count, no_index);
  std::vector<double> largest(old_count, 0);
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    for (const Parent& p : vertices[v])
      if (p.share > largest[p.row]) {
        largest[p.row] = p.share;
        successor[p.row] = v;
      }
  return successor;
}

} // namespace

void transfer_row(const Array& from, std::span<const Parent> parents, std::byte* to) {
  switch (from.transfer) {
  case Transfer::drop:
    throw std::logic_error("array \"" + from.name + "\" has the rule drop: it has no rows to transfer");
  case Transfer::copy:
    return copy_row(from, parents, to);
  case Transfer::interpolate:
  case Transfer::mean:
    if (parents.size() == 1) // no rounding, and values that are no numbers stay where they are
      return copy_row(from, parents, to);
    return sum_row(from, parents, &Parent::weight, to);
  case Transfer::conserve:
    return sum_row(from, parents, &Parent::share, to);
  case Transfer::common:
    return common_row(from, parents, to);
  }
}

Array transferred(const Array& old, const Lineage& lineage) {
  Array made = formats::make_array(old.name, old.place, old.type, old.components, old.unit, old.transfer,
                                   lineage.size(), old.critical);
  const std::size_t size = formats::size_of(old.type) * old.components;
  for (std::size_t row = 0; row < lineage.size(); ++row)
    transfer_row(old, lineage[row], made.data.data() + row * size);
  return made;
}

void Lineage::add(std::span<const Parent> parents) {
  parents_.insert(parents_.end(), parents.begin(), parents.end());
  first_.push_back(parents_.size());
}

Lineage Lineage::by_volume(std::span<const double> volumes) const {
  Lineage result = *this;
  for (std::size_t row = 0; row < size(); ++row) {
    const std::span<Parent> parents = std::span(result.parents_).subspan(first_[row], first_[row + 1] - first_[row]);
    double volume = 0;
    for (const Parent& p : parents)
      volume += p.share * volumes[p.row];
    for (Parent& p : parents)
      if (volume > 0)
        p.weight = p.share * volumes[p.row] / volume;
  }
  return result;
}

void transfer_frame(Frame& frame, const Lineage& vertices, const Lineage& triangles, std::span<const Corners> corners) {
  const EdgeRows old_edges(frame);
  CarriedSprings springs(frame);
  if (!springs.empty())
    springs.move(successors(vertices, frame.vertices));
  const bool any_mean =
      std::ranges::any_of(frame.arrays, [](const Array& array) { return array.transfer == Transfer::mean; });
  const Lineage mean = any_mean ? triangles.by_volume(volumes(std::as_const(frame))) : Lineage{};
  std::vector<Array> arrays = std::move(frame.arrays);
  frame.arrays.clear();
  frame.vertices = vertices.size();
  frame.triangles = triangles.size();
  for (Array& array : arrays) {
    if (array.name == "triangle") {
      Array made = formats::make_array(array.name, array.place, array.type, array.components, array.unit,
                                       array.transfer, corners.size(), array.critical);
      if (!corners.empty())
        std::memcpy(made.data.data(), corners.data(), corners.size_bytes());
      frame.arrays.push_back(std::move(made));
    } else if (CarriedSprings::has(array.name)) {
      frame.arrays.push_back(std::move(array)); // its place in the order; the rows are put below
    } else if (array.transfer == Transfer::drop) {
      continue;
    } else if (array.transfer == Transfer::mean) {
      frame.arrays.push_back(transferred(array, mean));
    } else if (array.place == Place::vertex || array.place == Place::triangle) {
      frame.arrays.push_back(transferred(array, array.place == Place::vertex ? vertices : triangles));
    } else {
      frame.arrays.push_back(std::move(array));
    }
  }
  springs.put(frame);
  old_edges.put(frame);
}

} // namespace sheet
