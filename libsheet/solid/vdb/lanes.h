// SPDX-License-Identifier: GPL-3.0-or-later
// Eight places at a time, in single precision, on the processor that is there: the same bits on each, as products and
// sums stay apart.
#pragma once
#include <array>
#include <cstddef>

#include "libsheet/base/instruction_sets.h"

namespace sheet::solid {

inline constexpr int lane_count = 8;
using Lanes = float __attribute__((vector_size(4 * lane_count)));

struct LanePlace {
  Lanes x, y, z;
};

// How lanes are kept and handed over: how Lanes are aligned depends on the instruction set.
using KeptLanes = std::array<float, lane_count>;

[[gnu::always_inline]] inline void keep_lanes(const Lanes& lanes, KeptLanes& kept) {
  for (int i = 0; i < lane_count; ++i)
    kept[static_cast<std::size_t>(i)] = lanes[i];
}

// Before a function with loops over lanes.
#define SHEET_FOR_EACH_PROCESSOR SHEET_FOR_INSTRUCTION_SETS("avx2")

} // namespace sheet::solid
