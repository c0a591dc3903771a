// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/slab_union.h"

#include "libsheet/base/each.h"
#include "libsheet/solid/level_set_module.h"
#include "libsheet/solid/triangle_distance.h"
#include "libsheet/solid/vdb/level_sets.h"

namespace sheet::solid {

SlabUnion unite(const Slabs& slabs, const UnionOptions& options) {
  SlabUnion result = level_set_module().unite(slabs, options);
  each_in_parallel(result.origins.size(), [&](std::size_t i) {
    SlabPoint& origin = result.origins[i];
    const Corners& c = slabs.triangles[origin.triangle];
    origin.weights =
        nearest_on_triangle(result.surface.points[i], {slabs.points[c[0]], slabs.points[c[1]], slabs.points[c[2]]})
            .weights;
  });
  return result;
}

} // namespace sheet::solid
