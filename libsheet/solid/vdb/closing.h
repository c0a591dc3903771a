// SPDX-License-Identifier: GPL-3.0-or-later
// Closing of a body that is given by its field of distances. Unit: a voxel.
#pragma once
#include <functional>
#include <vector>

#include "libsheet/solid/vdb/slab_blocks.h"

namespace sheet::solid {

// The values of a field in a block of voxels, as SlabBlocks have them.
struct FieldBlock {
  Voxel origin;
  float* values;
};

// Adds to the body all that is within `length` of it, and then takes away all that is within `length` of the outside
// [Serra 1982]: the field f becomes the lesser of f and length - d, d the distance to what is outside after the first,
// f >= length; nothing below -depth. f must be right up to length + closing_margin, in blocks in any order;
// `elsewhere` has it where there is no block.
//
// It stays as it is where the way up along its gradient comes to length. What turns such a way back is a ridge of f, a
// place as far from two pieces of the surface; without one within length + depth nothing is looked at. Elsewhere d is
// the least of |x - y| - (f(y) - length) over the voxels y outside, as all that is nearer to y than f(y) - length is
// outside too; and over the places of that value between voxels. So d is too large by no more than what is between
// these, a tenth of a voxel before faces and up to half a one before edges. The same bits for any number of threads.
void close_field(const std::vector<FieldBlock>& blocks, const std::function<float(const Voxel&)>& elsewhere,
                 float length, float depth);

inline constexpr float closing_margin = 2;

} // namespace sheet::solid
