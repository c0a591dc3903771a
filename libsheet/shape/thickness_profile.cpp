// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/shape/thickness_profile.h"

#include <cmath>

namespace sheet {

double thickness_at(const Vector3& place, const scene::ThicknessProfile& profile, scene::Plane plane) {
  const scene::PlaneAxes axes = scene::axes_of(plane);
  const double s = profile.over == scene::SheetDirection::radial ? std::hypot(place[axes.first], place[axes.second])
                                                                 : place[static_cast<int>(profile.over)];
  return scene::value_at(profile.rows, s);
}

} // namespace sheet
