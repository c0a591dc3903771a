// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/slab_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sheet::solid {
namespace {

constexpr int part_side = SlabBlocks::side / 2;
const float part_half_diagonal = std::sqrt(3.0F) * (part_side - 1) / 2; // from the middle to the farthest voxel
constexpr float infinite = std::numeric_limits<float>::infinity();

} // namespace

void SlabField::fill(std::size_t block, float reach, std::array<float, SlabBlocks::voxels>& values) {
  const Voxel first = blocks_.origin(block);
  constexpr float half = (part_side - 1) / 2.0F, next = part_side; // from a part's first voxel to its middle
  const LanePlace middles{static_cast<float>(first.x()) + half + Lanes{0, 0, 0, 0, next, next, next, next},
                          static_cast<float>(first.y()) + half + Lanes{0, 0, next, next, 0, 0, next, next},
                          static_cast<float>(first.z()) + half + Lanes{0, next, 0, next, 0, next, 0, next}};
  const auto triangles = blocks_.triangles(block);
  parts_.resize(triangles.size());
  Lanes highest = infinite + Lanes{};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SlabTriangle& slab = blocks_.triangle(triangles[i]);
    slab.field_at(middles, parts_[i].at_centers);
    const Lanes most = parts_[i].at_centers + slab.steepness() * part_half_diagonal;
    highest = most < highest ? most : highest;
  }
  values.fill(infinite);
  for (int part = 0; part < 8; ++part) {
    const float up_to = std::min(highest[part], reach);
    near_.clear();
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (parts_[i].at_centers[part] - blocks_.triangle(triangles[i]).steepness() * part_half_diagonal <= up_to)
        near_.push_back(triangles[i]);
    fill_part(first, Voxel(part >> 2, part >> 1 & 1, part & 1) * part_side, values);
  }
}

// One eighth of a block, from the triangles that matter there.
void SlabField::fill_part(const Voxel& first, const Voxel& part, std::array<float, SlabBlocks::voxels>& values) const {
  const Lanes row{0, 0, 0, 0, 1, 1, 1, 1}, column{0, 1, 2, 3, 0, 1, 2, 3};
  for (int x = part.x(); x < part.x() + part_side; ++x)
    for (int y = part.y(); y < part.y() + part_side; y += 2) {
      const LanePlace place{static_cast<float>(first.x() + x) + Lanes{}, static_cast<float>(first.y() + y) + row,
                            static_cast<float>(first.z() + part.z()) + column};
      Lanes least = infinite + Lanes{};
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
