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

struct Voids {
  std::size_t filled = 0; // narrow ones
  std::size_t wide = 0;   // others
  std::size_t voxels = 0; // of the wide ones
};

class BodyGrid {
public:
  // The union of slabs, with values three voxels deep and as far outside as `reach`.
  BodyGrid(const SlabBlocks& blocks, float reach);
  ~BodyGrid();
  BodyGrid(const BodyGrid&) = delete;
  BodyGrid& operator=(const BodyGrid&) = delete;

  static constexpr float depth = 3; // what is deeper has the value -depth

  [[nodiscard]] std::size_t voxels() const; // that carry a value of their own
  [[nodiscard]] DepthCount depths() const;

  // Adds all that is within `length` of the body, and then takes away all that is within `length` of the outside: a
  // closing [Serra 1982]. The distance from the surface of what was added is found by fast sweeping [Zhao 2005].
  // `reach` must have been two voxels or more beyond the length.
  void close(float length);

  // Fills what is outside of the isosurface and enclosed by it, where a ball of `radius` voxels does not fit in (one of
  // steps from voxel to voxel), and remembers the rest of it, the wide voids.
  Voids fill_narrow_voids(float iso, int radius);
  // Whether a place is beside a voxel of a wide void.
  [[nodiscard]] bool is_beside_wide_void(const Vector3& x) const;
  void fill_wide_voids();

  // The isosurface, triangles counter-clockwise seen from outside. Quadrangles are cut along their shorter diagonal.
  [[nodiscard]] SolidSurface isosurface(double iso) const;

  // The isosurface as others expect a level set: a grid "surface" in metres, three voxels to either side, in OpenVDB's
  // file format. The field is used up.
  [[nodiscard]] std::string print(double iso, const VoxelSpace& space, double time) &&;

private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

} // namespace sheet::solid
