// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/way_of_sheet.h"

#include <algorithm>
#include <array>

#include "libsheet/geometry/area.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

solid::Box3 way_of_sheet(const formats::Frame& frame, const Vector3& fall) {
  const auto x = positions(frame);
  solid::Box3 box;
  for (std::size_t t = 0; t < frame.triangles; ++t) {
    const Corners& c = triangles(frame)[t];
    const double half = volumes(frame)[t] / TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area / 2;
    for (const std::uint32_t v : c)
      for (const double side : {-half, half})
        box.extend(Vector3((x[v].array() + side).matrix()));
  }
  if (!box.isEmpty())
    box.extend(box.translated(fall));
  return box;
}

double middle_size(const solid::Box3& box) {
  std::array<double, 3> sizes = {box.sizes().x(), box.sizes().y(), box.sizes().z()};
  std::ranges::sort(sizes);
  return sizes[1];
}

} // namespace sheet
