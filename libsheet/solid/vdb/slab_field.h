// SPDX-License-Identifier: GPL-3.0-or-later
// The field of a union of slabs at the voxels of a block: the least over its triangles. The least of numbers does not
// depend on their order, so neither do the bits on the number of threads. Unit: a voxel.
#pragma once
#include <array>
#include <vector>

#include "libsheet/solid/vdb/slab_blocks.h"

namespace sheet::solid {

class SlabField {
public:
  // The blocks must stay.
  explicit SlabField(const SlabBlocks& blocks) : blocks_(blocks) {}

  // The values of a block, where they are at most `reach`; others are above it.
  void fill(std::size_t block, float reach, std::array<float, SlabBlocks::voxels>& values);

private:
  void fill_part(const Voxel& first, const Voxel& part, std::array<float, SlabBlocks::voxels>& values) const;

  const SlabBlocks& blocks_;
  std::vector<KeptLanes> at_middles_; // of each triangle of the block: its field in the middles of the eight parts
  std::vector<std::uint32_t> near_;   // the triangles that matter in a part
};

} // namespace sheet::solid
