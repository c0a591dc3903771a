// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/slab_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "libsheet/geometry/box.h"
#include "libsheet/solid/vdb/lanes.h"

namespace sheet::solid {
namespace {

constexpr std::int32_t middle = 1 << (block_key_bits - 1);
const float half_diagonal =
    std::sqrt(3.0F) * SlabBlocks::side / 2; // of a block with all that lies nearest to its voxels

std::int32_t block_of(double x) { return static_cast<std::int32_t>(std::floor((x + 0.5) / SlabBlocks::side)); }

} // namespace

std::uint64_t block_key(const Voxel& block) {
  const auto axis = [&](int i) { return static_cast<std::uint64_t>(block[i] + middle); };
  return axis(0) << 2 * block_key_bits | axis(1) << block_key_bits | axis(2);
}

VoxelSpace::VoxelSpace(const Slabs& slabs, double voxel_size) : voxel(voxel_size) {
  Box3 box;
  for (const Corners& corners : slabs.triangles)
    for (const std::uint32_t v : corners)
      box.extend(slabs.points[v]);
  center = box.isEmpty() ? Vector3::Zero() : Vector3(box.center());
}

SlabBlocks::SlabBlocks(const Slabs& slabs, const VoxelSpace& space, double reach) {
  slabs_.reserve(slabs.triangles.size());
  std::vector<std::pair<Vector3, Vector3>> boxes;
  boxes.reserve(slabs.triangles.size());
  for (const Corners& c : slabs.triangles) {
    const std::array<Vector3, 3> x{space.in_voxels(slabs.points[c[0]]), space.in_voxels(slabs.points[c[1]]),
                                   space.in_voxels(slabs.points[c[2]])};
    const std::array<double, 3> h{slabs.thickness[c[0]] / space.voxel, slabs.thickness[c[1]] / space.voxel,
                                  slabs.thickness[c[2]] / space.voxel};
    slabs_.emplace_back(x, h);
    const Vector3 margin = Vector3::Constant(std::max({h[0], h[1], h[2]}) / 2 + reach);
    boxes.emplace_back(x[0].cwiseMin(x[1]).cwiseMin(x[2]) - margin, x[0].cwiseMax(x[1]).cwiseMax(x[2]) + margin);
  }
  constexpr std::size_t at_once = 64;
  std::vector<std::vector<Pair>> parts((slabs_.size() + at_once - 1) / at_once);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    for (std::size_t t = at_once * part; t < std::min(slabs_.size(), at_once * (part + 1)); ++t)
      add_blocks_of(static_cast<std::uint32_t>(t), boxes[t].first, boxes[t].second, reach, parts[part]);
  });
  std::vector<Pair> pairs;
  for (const std::vector<Pair>& part : parts)
    pairs.insert(pairs.end(), part.begin(), part.end());
  keep_nearest(std::move(pairs));
}

SHEET_FOR_EACH_PROCESSOR void SlabBlocks::add_blocks_of(std::uint32_t triangle, const Vector3& low, const Vector3& high,
                                                        double reach, std::vector<Pair>& pairs) const {
  const SlabTriangle& slab = slabs_[triangle];
  const float farthest = static_cast<float>(reach) + slab.steepness() * half_diagonal;
  const std::int32_t first = block_of(low.z()), last = block_of(high.z());
  constexpr float in_the_middle = (side - 1) / 2.0F;
  const Lanes numbers{0, 1, 2, 3, 4, 5, 6, 7};
  for (std::int32_t x = block_of(low.x()); x <= block_of(high.x()); ++x)
    for (std::int32_t y = block_of(low.y()); y <= block_of(high.y()); ++y)
      for (std::int32_t z = first; z <= last; z += lane_count) {
        const Lanes ones = 1 + Lanes{};
        const LanePlace place{ones * (static_cast<float>(side * x) + in_the_middle),
                              ones * (static_cast<float>(side * y) + in_the_middle),
                              (static_cast<float>(z) + numbers) * side + in_the_middle};
        Lanes f;
        slab.field_at(place, f);
        for (std::int32_t lane = 0; lane < std::min(lane_count, last - z + 1); ++lane)
          if (f[lane] <= farthest)
            pairs.push_back({block_key({x, y, z + lane}), triangle, f[lane]});
      }
}

// Of each block those whose least value in it is not above another's greatest.
void SlabBlocks::keep_nearest(std::vector<Pair> pairs) {
  tbb::parallel_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::pair(a.block, a.triangle) < std::pair(b.block, b.triangle);
  });
  for (auto begin = pairs.cbegin(); begin != pairs.cend();) {
    const auto end = std::find_if(begin, pairs.cend(), [&](const Pair& p) { return p.block != begin->block; });
    float highest = std::numeric_limits<float>::infinity();
    for (auto p = begin; p != end; ++p)
      highest = std::min(highest, p->at_center + slabs_[p->triangle].steepness() * half_diagonal);
    keys_.push_back(begin->block);
    first_.push_back(triangles_.size());
    for (auto p = begin; p != end; ++p)
      if (p->at_center - slabs_[p->triangle].steepness() * half_diagonal <= highest)
        triangles_.push_back(p->triangle);
    begin = end;
  }
  first_.push_back(triangles_.size());
}

Voxel SlabBlocks::origin(std::size_t block) const {
  const auto axis = [&](int number) {
    const auto value =
        static_cast<std::int32_t>(keys_[block] >> number * block_key_bits & ((1U << block_key_bits) - 1));
    return side * (value - middle);
  };
  return {axis(2), axis(1), axis(0)};
}

std::optional<std::size_t> SlabBlocks::find(const Voxel& voxel) const {
  const std::uint64_t key = block_key({voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3});
  const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
  if (found == keys_.end() || *found != key)
    return {};
  return static_cast<std::size_t>(found - keys_.begin());
}

} // namespace sheet::solid
