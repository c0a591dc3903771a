// SPDX-License-Identifier: GPL-3.0-or-later
// A body as a field of distances on the voxels near its surface, negative within: all that OpenVDB does for a union of
// slabs. Unit: a voxel.
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "libsheet/solid/mesh.h"
#include "libsheet/solid/vdb/depth_count.h"
#include "libsheet/solid/vdb/slab_blocks.h"

namespace sheet::solid {

class BodyGrid {
public:
  // The union of slabs, with values as deep within as `depth` and as far outside as `reach`. What is deeper has the
  // value -depth.
  BodyGrid(const SlabBlocks& blocks, float depth, float reach);
  ~BodyGrid();
  BodyGrid(const BodyGrid&) = delete;
  BodyGrid& operator=(const BodyGrid&) = delete;

  [[nodiscard]] std::size_t voxels() const;               // that carry a value of their own
  [[nodiscard]] DepthCount depths(double last_iso) const; // depth_count.h

  // closing.h. `reach` must have been beyond the length by closing_margin or more.
  void close(float length);

  // The isosurface, triangles counter-clockwise seen from outside. Quadrangles are cut along their shorter diagonal.
  [[nodiscard]] SolidSurface isosurface(double iso) const;

private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
  float depth_;
};

// The level set of a closed surface as a file of OpenVDB: a grid "surface" in metres, three voxels to either side. The
// surface is in voxels. The same input gives the same bits.
[[nodiscard]] std::string print_level_set(const SolidSurface& surface, const VoxelSpace& space, double time);

} // namespace sheet::solid
