// SPDX-License-Identifier: GPL-3.0-or-later
// Candidates come from boxes [Zomorodian, Edelsbrunner 2002; CGAL's box_self_intersection_d].
#include "libsheet/measure/intersections.h"

#include <algorithm>

#include <CGAL/box_intersection_d.h>

#include "libsheet/geometry/triangle_pair.h"

namespace sheet {

namespace {

using Eigen::Vector3d;
using Box = CGAL::Box_intersection_d::Box_d<double, 3, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

} // namespace

std::vector<std::uint64_t> find_degenerate(std::span<const Vector3d> x, std::span<const Corners> triangles,
                                           const std::vector<bool>& usable) {
  std::vector<std::uint64_t> found;
  for (std::uint64_t t = 0; t < triangles.size(); ++t)
    if (usable[t] && corners_collinear(x, triangles[t]))
      found.push_back(t);
  return found;
}

Intersections find_intersections(std::span<const Vector3d> x, std::span<const Corners> triangles,
                                 const std::vector<bool>& usable, std::size_t limit) {
  std::vector<Box> boxes;
  std::vector<std::uint64_t> triangle_of;
  boxes.reserve(triangles.size());
  triangle_of.reserve(triangles.size());
  for (std::uint64_t t = 0; t < triangles.size(); ++t) {
    if (!usable[t])
      continue;
    const Corners& c = triangles[t];
    Vector3d low = x[c[0]].cwiseMin(x[c[1]]).cwiseMin(x[c[2]]);
    Vector3d high = x[c[0]].cwiseMax(x[c[1]]).cwiseMax(x[c[2]]);
    boxes.emplace_back(low.data(), high.data());
    triangle_of.push_back(t);
  }
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& box : boxes)
    pointers.push_back(&box);

  Intersections result;
  const auto keep_smallest = [&] {
    std::sort(result.pairs.begin(), result.pairs.end());
    if (result.pairs.size() > limit)
      result.pairs.resize(limit);
  };
  const auto test = [&](const Box* one, const Box* other) {
    const auto [first, second] = std::minmax(triangle_of[static_cast<std::size_t>(one - boxes.data())],
                                             triangle_of[static_cast<std::size_t>(other - boxes.data())]);
    if (!triangles_intersect(x, triangles[first], triangles[second]))
      return;
    ++result.count;
    result.pairs.emplace_back(first, second);
    if (result.pairs.size() >= 2 * limit + 1024)
      keep_smallest();
  };
  CGAL::box_self_intersection_d(pointers.begin(), pointers.end(), test);
  keep_smallest();
  return result;
}

} // namespace sheet
