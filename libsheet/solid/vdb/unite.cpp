// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/unite.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <openvdb/openvdb.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/base/stopwatch.h"
#include "libsheet/solid/vdb/body_grid.h"
#include "libsheet/solid/vdb/body_surface.h"
#include "libsheet/solid/vdb/slab_blocks.h"

namespace sheet::solid {
namespace {

Voxel voxel_of(const Vector3& x) { return (x.array() + 0.5).floor().matrix().cast<int>(); }

// Which block of space it is in, counted along each axis.
Voxel block_place(const Vector3& x) { return ((x.array() + 0.5) / SlabBlocks::side).floor().matrix().cast<int>(); }

// The triangles where points of the surface come from; `count` points, all of one block, from the first on.
void find_origins(const SlabBlocks& blocks, std::size_t block, const Vector3* points, SlabPoint* origins, int count) {
  LanePlace place{};
  for (int i = 0; i < lane_count; ++i) {
    const Vector3& x = points[std::min(i, count - 1)];
    place.x[i] = static_cast<float>(x.x());
    place.y[i] = static_cast<float>(x.y());
    place.z[i] = static_cast<float>(x.z());
  }
  Lanes least = std::numeric_limits<float>::infinity() + Lanes{};
  for (const std::uint32_t t : blocks.triangles(block)) {
    Lanes f;
    blocks.triangle(t).field_at(place, f);
    for (int i = 0; i < count; ++i)
      if (f[i] < least[i]) {
        least[i] = f[i];
        origins[i].triangle = t;
      }
  }
}

std::vector<SlabPoint> origins_of(const SlabBlocks& blocks, const std::vector<Vector3>& points) {
  std::vector<SlabPoint> origins(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end();) {
      const Voxel place = block_place(points[i]);
      std::size_t end = i + 1;
      while (end < range.end() && end - i < lane_count && block_place(points[end]) == place)
        ++end;
      if (const auto block = blocks.find(voxel_of(points[i])))
        find_origins(blocks, *block, &points[i], &origins[i], static_cast<int>(end - i));
      i = end;
    }
  });
  return origins;
}

// Fills what voids are to be filled and chooses the iso value for the volume, anew as that changes what is a void.
double iso_of_volume(const UnionOptions& options, BodyGrid& body, Voids& voids) {
  const double volume = options.volume / std::pow(options.voxel, 3);
  double iso = body.depths().iso_of(volume);
  if (options.keep_voids)
    return iso;
  const int radius = std::max(1, static_cast<int>(std::lround(options.wide / options.voxel / 2)));
  std::size_t filled = 0;
  for (int round = 0; round < 4; ++round) {
    voids = body.fill_narrow_voids(static_cast<float>(iso), radius);
    if (voids.filled == 0)
      break;
    filled += voids.filled;
    iso = body.depths().iso_of(volume);
  }
  voids.filled = filled;
  return iso;
}

} // namespace

SlabUnion unite_slabs(const Slabs& slabs, const UnionOptions& options) {
  openvdb::initialize();
  SlabUnion result;
  Stopwatch watch;
  const VoxelSpace space(slabs, options.voxel);
  const double voxel_volume = std::pow(options.voxel, 3);
  const auto close = static_cast<float>(options.close / options.voxel);
  const float reach = BodyGrid::depth + close;
  const SlabBlocks blocks(slabs, space, reach);
  BodyGrid body(blocks, reach);
  result.seconds.field = watch.lap();
  result.voxels = body.voxels();
  result.union_volume = voxel_volume * body.depths().volume(0);
  result.seconds.volume = watch.lap();
  if (close > 0 && result.voxels > 0)
    body.close(close);
  result.seconds.closing = watch.lap();
  Voids voids;
  const double iso = iso_of_volume(options, body, voids);
  result.voids = voids.filled + voids.wide;
  result.air = voxel_volume * static_cast<double>(voids.voxels);
  result.seconds.volume += watch.lap();
  constexpr double farthest = 0.5; // that the volume of the mesh is off by, in voxels
  result.surface = body.isosurface(iso);
  const double more = inflate_to(options.volume / voxel_volume, farthest, result.surface);
  result.shift = options.voxel * (iso + more);
  result.volume_reached = std::abs(iso) < 0.99 * DepthCount::last_iso && std::abs(more) < 0.99 * farthest;
  if (voids.wide > 0)
    drop_parts([&](const Vector3& x) { return body.is_beside_wide_void(x); }, result.surface);
  result.seconds.mesh = watch.lap();
  result.origins = origins_of(blocks, result.surface.points);
  for (Vector3& x : result.surface.points)
    x = space.in_metres(x);
  result.seconds.origins = watch.lap();
  if (options.level_set) {
    body.fill_wide_voids();
    result.level_set = std::move(body).print(iso + more, space, options.time);
    result.seconds.level_set = watch.lap();
  }
  return result;
}

} // namespace sheet::solid
