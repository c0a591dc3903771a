// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles can be the nearest, in the sense of a slab's field, in which blocks of 8 x 8 x 8 voxels.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libsheet/solid/slab_union.h"
#include "libsheet/solid/vdb/slab_triangle.h"

namespace sheet::solid {

using Voxel = Eigen::Vector3i;

// Space in voxels; voxel (0, 0, 0) is in the middle of the sheet, so that single precision is enough at any scale.
struct VoxelSpace {
  Vector3 center;
  double voxel; // [m]
  VoxelSpace(const Slabs& slabs, double voxel_size);
  [[nodiscard]] Vector3 in_voxels(const Vector3& x) const { return (x - center) / voxel; }
  [[nodiscard]] Vector3 in_metres(const Vector3& x) const { return center + voxel * x; }
};

// A number for a block, counted in blocks along each axis, by which they are in order.
inline constexpr int block_key_bits = 21; // of an axis
std::uint64_t block_key(const Voxel& block);

class SlabBlocks {
public:
  // All blocks where the field is below `reach` voxels somewhere.
  SlabBlocks(const Slabs& slabs, const VoxelSpace& space, double reach);

  static constexpr int side = 8;                            // of a block, a leaf of OpenVDB's trees
  static constexpr std::size_t voxels = side * side * side; // in a block, z fastest

  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  [[nodiscard]] Voxel origin(std::size_t block) const;
  // In rising order: every triangle that has the least field somewhere in the block.
  [[nodiscard]] std::span<const std::uint32_t> triangles(std::size_t block) const {
    return std::span(triangles_).subspan(first_[block], first_[block + 1] - first_[block]);
  }
  // The block where a voxel is.
  [[nodiscard]] std::optional<std::size_t> find(const Voxel& voxel) const;
  [[nodiscard]] const SlabTriangle& triangle(std::uint32_t number) const { return slabs_[number]; }

private:
  struct Pair { // a triangle that may matter in a block
    std::uint64_t block;
    std::uint32_t triangle;
    float at_center; // its field in the middle of the block
  };
  void add_blocks_of(std::uint32_t triangle, const Vector3& low, const Vector3& high, double reach,
                     std::vector<Pair>& pairs) const;
  void keep_nearest(std::vector<Pair> pairs);

  std::vector<SlabTriangle> slabs_;
  std::vector<std::uint64_t> keys_; // of blocks, rising
  std::vector<std::size_t> first_;  // of a block's triangles, and the end
  std::vector<std::uint32_t> triangles_;
};

} // namespace sheet::solid
