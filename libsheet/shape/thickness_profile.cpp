// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/thickness_profile.h"

#include <algorithm>
#include <cmath>

namespace sheet {

double thickness_at(const Vector3& place, const scene::ThicknessProfile& profile, scene::Plane plane) {
  const scene::PlaneAxes axes = scene::axes_of(plane);
  const double s = profile.over == scene::SheetDirection::radial ? std::hypot(place[axes.first], place[axes.second])
                                                                 : place[static_cast<int>(profile.over)];
  const auto& rows = profile.rows;
  const auto after = std::ranges::upper_bound(rows, s, {}, [](const auto& row) { return row[0]; });
  if (after == rows.begin())
    return rows.front()[1];
  if (after == rows.end())
    return rows.back()[1];
  const auto before = after - 1;
  return std::lerp((*before)[1], (*after)[1], (s - (*before)[0]) / ((*after)[0] - (*before)[0]));
}

} // namespace sheet
