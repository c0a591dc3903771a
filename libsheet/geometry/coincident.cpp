// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/coincident.h"

#include <algorithm>
#include <numeric>

namespace sheet {

std::vector<bool> coincident(std::span<const Vector3> points, double close) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return points[i].x(); });
  std::vector<bool> paired(points.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && points[order[j]].x() - points[order[i]].x() <= close; ++j)
      if ((points[order[j]] - points[order[i]]).norm() <= close)
        paired[order[i]] = paired[order[j]] = true;
  return paired;
}

} // namespace sheet
