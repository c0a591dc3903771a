// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/crossings.h"

#include <algorithm>

#include "libsheet/geometry/box.h"
#include "libsheet/geometry/triangle_pair.h"

namespace sheet::flow {

bool moved_triangles_cross(std::span<const Vector3> x, std::span<const Corners> triangles,
                           const std::vector<bool>& moved) {
  std::vector<std::size_t> own;
  Box around;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (std::ranges::any_of(triangles[t], [&](std::uint32_t v) { return moved[v]; })) {
      own.push_back(t);
      around.add(box_of(x, triangles[t]));
    }
  for (std::size_t other = 0; other < triangles.size(); ++other)
    if (const Box box = box_of(x, triangles[other]); around.overlaps(box))
      for (const std::size_t t : own)
        if (t != other && box_of(x, triangles[t]).overlaps(box) &&
            triangles_intersect(x, triangles[t], triangles[other]))
          return true;
  return false;
}

} // namespace sheet::flow
