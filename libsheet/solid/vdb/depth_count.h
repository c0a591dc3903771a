// SPDX-License-Identifier: GPL-3.0-or-later
// How many voxels of a field of distances lie how deep: the volume within every isosurface, without looking at the
// field again. Unit: a voxel.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace sheet::solid {

class DepthCount {
public:
  explicit DepthCount(double last_iso);

  void add(std::span<const float> values);
  void add_deep(std::size_t voxels) { deeper_ += voxels; } // below all iso values
  void add(const DepthCount& other);

  // What lies below `iso`, which is in [-last_iso, last_iso]: a voxel at the distance d from it counts as 1/2 - d, 0
  // to 1.
  [[nodiscard]] double volume(double iso) const;

  // The iso value of that volume, by bisection; the nearer end of the range if there is none.
  [[nodiscard]] double iso_of(double volume) const;

private:
  double last_iso_;
  std::vector<std::size_t> counts_; // by value
  std::size_t deeper_ = 0;          // than the first of them
};

} // namespace sheet::solid
