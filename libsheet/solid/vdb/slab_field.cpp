// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/slab_field.h"

#include <algorithm>
#include <limits>

#include "libsheet/solid/vdb/block_parts.h"
#include "libsheet/solid/vdb/lanes.h"

namespace sheet::solid {
namespace {

static_assert(part_side == SlabBlocks::side / 2);
constexpr float no_field = std::numeric_limits<float>::infinity();

} // namespace

SHEET_FOR_EACH_PROCESSOR void SlabField::fill(std::size_t block, float reach,
                                              std::array<float, SlabBlocks::voxels>& values) {
  const Voxel first = blocks_.origin(block);
  LanePlace middles;
  find_middles(first.x(), first.y(), first.z(), middles);
  const auto triangles = blocks_.triangles(block);
  at_middles_.resize(triangles.size());
  Lanes highest = no_field + Lanes{};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SlabTriangle& slab = blocks_.triangle(triangles[i]);
    Lanes f;
    slab.field_at(middles, f);
    keep_lanes(f, at_middles_[i]);
    const Lanes most = f + slab.steepness() * part_half_diagonal;
    highest = most < highest ? most : highest;
  }
  values.fill(no_field);
  for (std::size_t part = 0; part < 8; ++part) {
    const float up_to = std::min(highest[static_cast<int>(part)], reach);
    near_.clear();
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (at_middles_[i][part] - blocks_.triangle(triangles[i]).steepness() * part_half_diagonal <= up_to)
        near_.push_back(triangles[i]);
    fill_part(first, Voxel(part >> 2 & 1, part >> 1 & 1, part & 1) * part_side, values);
  }
}

// One eighth of a block, from the triangles that matter there.
SHEET_FOR_EACH_PROCESSOR void SlabField::fill_part(const Voxel& first, const Voxel& part,
                                                   std::array<float, SlabBlocks::voxels>& values) const {
  const Lanes row{0, 0, 0, 0, 1, 1, 1, 1}, column{0, 1, 2, 3, 0, 1, 2, 3};
  for (int x = part.x(); x < part.x() + part_side; ++x)
    for (int y = part.y(); y < part.y() + part_side; y += 2) {
      const LanePlace place{static_cast<float>(first.x() + x) + Lanes{}, static_cast<float>(first.y() + y) + row,
                            static_cast<float>(first.z() + part.z()) + column};
      Lanes least = no_field + Lanes{};
      for (const std::uint32_t t : near_) {
        Lanes f;
        blocks_.triangle(t).field_at(place, f);
        least = f < least ? f : least;
      }
      for (int i = 0; i < lane_count; ++i)
        values[static_cast<std::size_t>(x << 6 | (y + i / part_side) << 3 | (part.z() + i % part_side))] = least[i];
    }
}

} // namespace sheet::solid
