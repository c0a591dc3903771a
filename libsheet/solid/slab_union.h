// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of the liquid of all layers of a sheet: the union of its triangles as slabs with round edges, as a level
// set (vdb/slab_triangle.h has the formula), closed and of a given volume. It needs no orientation, and sheets may
// cross themselves. OpenVDB is loaded for it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libsheet/geometry/types.h"
#include "libsheet/solid/mesh.h"

namespace sheet::solid {

struct Slabs {
  std::span<const Vector3> points;   // of the middle surface [m]
  std::span<const double> thickness; // at the points [m]
  std::span<const Corners> triangles;
};

struct UnionOptions {
  double volume = 0;    // that the surface shall hold [m³]
  double voxel = 0;     // [m]
  double close = 0;     // gaps between layers are closed where they are narrower than twice this [m]; 0: none
  double thickness = 0; // of layers, their median [m]: voids that are wider than this on average are air, and no part
                        // of the volume; for the volume the surface is shifted by some half of it at most
  bool keep_voids = false;
  bool level_set = false; // also the level set as a .vdb file
  double time = 0;        // [s], for that file
};

// The point of a triangle where a point of the surface comes from: the one of which f is least.
struct SlabPoint {
  std::uint32_t triangle = 0;
  std::array<double, 3> weights{}; // of its corners
};

struct SlabUnion {
  SolidSurface surface;           // closed, in parts that do not touch; empty if nothing is as thick as a voxel
  std::vector<SlabPoint> origins; // one for each of its points
  std::string level_set;          // in the format of OpenVDB: a grid "surface", in metres
  std::size_t voxels = 0;         // that carry a distance of their own
  double union_volume = 0;        // of the slabs, before gaps are closed [m³]
  double shift = 0;               // outwards, by which the surface got its volume [m]
  bool volume_reached = true;     // not if layers lie in each other deeper than it can be shifted
  std::size_t voids = 0;          // that were filled
  double air = 0;                 // in those of them that are wide [m³]
  struct {
    double field = 0, closing = 0, volume = 0, mesh = 0, origins = 0, level_set = 0;
  } seconds;
};

// The same bits for any number of threads. Precondition: the slabs are less than 4e6 voxels across.
[[nodiscard]] SlabUnion unite(const Slabs& slabs, const UnionOptions& options);

} // namespace sheet::solid
