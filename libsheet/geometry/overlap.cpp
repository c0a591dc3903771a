// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/geometry/overlap.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace sheet {

namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

} // namespace

PlaneFrame::PlaneFrame(const Vector3& normal) {
  first = normal.unitOrthogonal();
  second = normal.cross(first);
}

Overlap overlap_of(const FlatTriangle& a, const FlatTriangle& b) {
  for (int axis = 0; axis < 2; ++axis) {
    const auto [a_low, a_high] = std::minmax({a[0][axis], a[1][axis], a[2][axis]});
    const auto [b_low, b_high] = std::minmax({b[0][axis], b[1][axis], b[2][axis]});
    if (a_high <= b_low || b_high <= a_low)
      return {};
  }
  // a's polygon, cut by each side of b in turn; a triangle cut by three lines has at most six corners
  std::array<Eigen::Vector2d, 8> polygon, cut;
  std::size_t size = 3;
  std::copy(a.begin(), a.end(), polygon.begin());
  const double turn = cross(b[1] - b[0], b[2] - b[0]) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3 && size > 0; ++i) {
    const Eigen::Vector2d& from = b[i];
    const Eigen::Vector2d along = turn * (b[(i + 1) % 3] - from);
    std::size_t left = 0;
    double last = cross(along, polygon[size - 1] - from);
    for (std::size_t k = 0; k < size; ++k) {
      const double here = cross(along, polygon[k] - from);
      const Eigen::Vector2d& before = polygon[k == 0 ? size - 1 : k - 1];
      if ((here > 0 && last < 0) || (here < 0 && last > 0))
        cut[left++] = before + (last / (last - here)) * (polygon[k] - before);
      if (here >= 0)
        cut[left++] = polygon[k];
      last = here;
    }
    polygon = cut;
    size = left;
  }
  double twice = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t k = 2; k < size; ++k) {
    const double part = cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    twice += part;
    moment += part * (polygon[0] + polygon[k - 1] + polygon[k]) / 3;
  }
  if (twice == 0)
    return {};
  return {std::abs(twice) / 2, moment / twice};
}

} // namespace sheet
