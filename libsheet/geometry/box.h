// SPDX-License-Identifier: GPL-3.0-or-later
// An axis-aligned box; without points it is empty.
#pragma once
#include <limits>
#include <span>

#include "libsheet/geometry/types.h"

namespace sheet {

struct Box {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vector3& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  // With all that is within `margin` of x along each axis.
  void add(const Vector3& x, double margin) {
    low = low.cwiseMin((x.array() - margin).matrix());
    high = high.cwiseMax((x.array() + margin).matrix());
  }
  void add(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] bool empty() const { return !(low.array() <= high.array()).all(); }
  [[nodiscard]] bool holds(const Vector3& x) const {
    return (low.array() <= x.array()).all() && (x.array() <= high.array()).all();
  }
  [[nodiscard]] bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  [[nodiscard]] Vector3 middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double half_size() const { return (high - low).maxCoeff() / 2; }
  [[nodiscard]] double diagonal() const { return empty() ? 0 : (high - low).norm(); }
};

// Of a triangle.
[[nodiscard]] inline Box box_of(std::span<const Vector3> positions, const Corners& triangle) {
  Box box;
  for (const std::uint32_t v : triangle)
    box.add(positions[v]);
  return box;
}

} // namespace sheet
