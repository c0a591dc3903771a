// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes in single precision, rounded outward, one and eight at a time: whether they may overlap, in a few instructions.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "libsheet/geometry/box.h"

namespace sheet {

struct QuickBox {
  using Four = float __attribute__((vector_size(16)));
  Four low = {3e38F, 3e38F, 3e38F, 0}, high = {-3e38F, -3e38F, -3e38F, 0}; // the fourth tells nothing apart

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
  // With all that is within `margin` of it along each axis.
  [[nodiscard]] QuickBox grown(float margin) const {
    const auto by = [&](const Four& x) -> Four { return margin + (((x < 0 ? -x : x) + margin) * 0x1p-22F + 1e-37F); };
    QuickBox box;
    box.low = low - by(low);
    box.high = high + by(high);
    return box;
  }
  [[nodiscard]] bool operator==(const QuickBox& other) const {
    const auto other_places = reinterpret_cast<Halves>((low != other.low) | (high != other.high));
    return (other_places[0] | other_places[1]) == 0;
  }
  // False only if the boxes surely have no point in common.
  [[nodiscard]] bool may_overlap(const QuickBox& other) const {
    const auto apart = reinterpret_cast<Halves>((low > other.high) | (other.low > high));
    return (apart[0] | apart[1]) == 0;
  }

private:
  using Halves = long long __attribute__((vector_size(16)));
};

// What eight lanes say, each 0 or -1.
struct LaneMask {
  using Four = std::int32_t __attribute__((vector_size(16)));
  Four first, second;

  LaneMask operator|(const LaneMask& other) const { return {first | other.first, second | other.second}; }
  LaneMask operator~() const { return {~first, ~second}; }
  // A bit for each, lane 0 the lowest.
  [[nodiscard]] unsigned bits() const {
#ifdef __SSE2__
    using Floats = float __attribute__((vector_size(16)));
    return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Floats>(first)) |
                                 __builtin_ia32_movmskps(reinterpret_cast<Floats>(second)) << 4);
#else
    using Halves = std::uint64_t __attribute__((vector_size(16)));
    const auto all = reinterpret_cast<Halves>((first & Four{1, 2, 4, 8}) | (second & Four{16, 32, 64, 128}));
    const std::uint64_t both = all[0] | all[1];
    return static_cast<unsigned>(both | both >> 32U) & 0xFFU;
#endif
  }
};

// Eight boxes; those that were not put are empty, and overlap none.
struct BoxLanes {
  static constexpr std::size_t count = 8;

  void put(std::size_t lane, const QuickBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis][lane / 4][lane % 4] = box.low[axis];
      high_[axis][lane / 4][lane % 4] = box.high[axis];
    }
  }
  [[nodiscard]] QuickBox operator[](std::size_t lane) const {
    QuickBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = low_[axis][lane / 4][lane % 4];
      box.high[axis] = high_[axis][lane / 4][lane % 4];
    }
    return box;
  }
  // The lanes that may overlap with the box, as bits.
  [[nodiscard]] unsigned may_overlap(const QuickBox& box) const {
    const auto apart = [&](std::size_t i) {
      return (low_[0][i] > box.high[0]) | (high_[0][i] < box.low[0]) | (low_[1][i] > box.high[1]) |
             (high_[1][i] < box.low[1]) | (low_[2][i] > box.high[2]) | (high_[2][i] < box.low[2]);
    };
    return (~LaneMask{apart(0), apart(1)}).bits();
  }

private:
  using Row = std::array<QuickBox::Four, 2>;
  static constexpr Row all(float x) { return {QuickBox::Four{x, x, x, x}, QuickBox::Four{x, x, x, x}}; }
  std::array<Row, 3> low_ = {all(3e38F), all(3e38F), all(3e38F)}, high_ = {all(-3e38F), all(-3e38F), all(-3e38F)};
};

// Eight numbers; those that were not put have all bits, and equal no index.
struct IndexLanes {
  void put(std::size_t lane, std::uint32_t index) { values_[lane / 4][lane % 4] = static_cast<std::int32_t>(index); }
  [[nodiscard]] std::uint32_t operator[](std::size_t lane) const {
    return static_cast<std::uint32_t>(values_[lane / 4][lane % 4]);
  }
  // The lanes that equal the index.
  [[nodiscard]] LaneMask equal(std::uint32_t index) const {
    const auto i = static_cast<std::int32_t>(index);
    return {values_[0] == i, values_[1] == i};
  }
  // The lanes that have the bit of this number.
  [[nodiscard]] LaneMask having(std::size_t bit) const {
    const auto b = static_cast<std::int32_t>(1U << bit);
    return {(values_[0] & b) != 0, (values_[1] & b) != 0};
  }

private:
  std::array<LaneMask::Four, 2> values_ = {LaneMask::Four{-1, -1, -1, -1}, LaneMask::Four{-1, -1, -1, -1}};
};

} // namespace sheet
