// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/vdb/unite.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <openvdb/openvdb.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "libsheet/base/stopwatch.h"
#include "libsheet/solid/vdb/body_grid.h"
#include "libsheet/solid/vdb/body_surface.h"
#include "libsheet/solid/vdb/lanes.h"
#include "libsheet/solid/vdb/slab_blocks.h"

namespace sheet::solid {
namespace {

Voxel voxel_of(const Vector3& x) { return (x.array() + 0.5).floor().matrix().cast<int>(); }

// Which block of space it is in, counted along each axis.
Voxel block_place(const Vector3& x) { return ((x.array() + 0.5) / SlabBlocks::side).floor().matrix().cast<int>(); }

// The triangles where points of the surface come from; `count` points, all of one block, from the first on.
SHEET_FOR_EACH_PROCESSOR void find_origins(const SlabBlocks& blocks, std::size_t block, const Vector3* points,
                                           SlabPoint* origins, int count) {
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

// The body and the iso value that gives it the volume, as far as layers of the median thickness can lose or gain it.
struct Body {
  std::unique_ptr<SlabBlocks> blocks;
  std::unique_ptr<BodyGrid> grid;
  double iso = 0, last_iso = 0;
};

Body find_body(const Slabs& slabs, const UnionOptions& options, const VoxelSpace& space, SlabUnion& result) {
  const double voxel_volume = std::pow(options.voxel, 3), farthest = options.thickness / options.voxel / 2;
  const auto close = static_cast<float>(options.close / options.voxel);
  Stopwatch watch;
  for (double last_iso = 2;; last_iso *= 2) { // a wider band costs more, and is hardly ever needed
    Body body;
    body.last_iso = last_iso;
    const auto band = static_cast<float>(last_iso + 1);
    body.blocks = std::make_unique<SlabBlocks>(slabs, space, band + close);
    body.grid = std::make_unique<BodyGrid>(*body.blocks, band, band + close);
    result.seconds.field += watch.lap();
    result.voxels = body.grid->voxels();
    result.union_volume = voxel_volume * body.grid->depths(last_iso).volume(0);
    result.seconds.volume += watch.lap();
    if (close > 0 && result.voxels > 0)
      body.grid->close(close);
    result.seconds.closing += watch.lap();
    body.iso = body.grid->depths(last_iso).iso_of(options.volume / voxel_volume);
    result.seconds.volume += watch.lap();
    if (std::abs(body.iso) < 0.99 * last_iso || last_iso > farthest)
      return body;
  }
}

// The surface of the body, in voxels, with voids or without them.
void find_surface(const UnionOptions& options, Body& body, SlabUnion& result) {
  const double voxel_volume = std::pow(options.voxel, 3);
  constexpr double farthest = 0.5,
                   far = 0.1; // that points are moved for the volume, and without looking again, in voxels
  double way = 0;
  for (int round = 0; round < 4; ++round) {
    result.surface = body.grid->isosurface(body.iso);
    const Voids voids = options.keep_voids ? Voids{} : drop_voids(options.thickness / options.voxel, result.surface);
    result.voids = voids.count;
    result.air = voxel_volume * voids.air;
    way = inflate_to(options.volume / voxel_volume + voids.air, farthest, result.surface);
    if (std::abs(way) < far || std::abs(body.iso + way) > body.last_iso)
      break;
    body.iso += way;
  }
  result.shift = options.voxel * (body.iso + way);
  result.volume_reached = std::abs(body.iso) < 0.99 * body.last_iso && std::abs(way) < 0.99 * farthest;
}

} // namespace

SlabUnion unite_slabs(const Slabs& slabs, const UnionOptions& options) {
  openvdb::initialize();
  SlabUnion result;
  const VoxelSpace space(slabs, options.voxel);
  if (slabs.triangles.empty()) {
    if (options.level_set)
      result.level_set = print_level_set({}, space, options.time);
    return result;
  }
  Body body = find_body(slabs, options, space, result);
  Stopwatch watch;
  find_surface(options, body, result);
  result.seconds.mesh = watch.lap();
  result.origins = origins_of(*body.blocks, result.surface.points);
  result.seconds.origins = watch.lap();
  if (options.level_set) {
    result.level_set = print_level_set(result.surface, space, options.time);
    result.seconds.level_set = watch.lap();
  }
  for (Vector3& x : result.surface.points)
    x = space.in_metres(x);
  return result;
}

} // namespace sheet::solid
