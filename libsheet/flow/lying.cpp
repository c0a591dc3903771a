// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/flow/lying.h"

#include <algorithm>
#include <cmath>

#include "libsheet/geometry/box_tree.h"
#include "libsheet/geometry/closest_points.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/overlap.h"

namespace sheet::flow {

namespace {

constexpr double reach = 1.5;         // mean thicknesses
constexpr double facing = 0.7;        // cosine
constexpr double least_height = 0.25; // of the neighbour's

} // namespace

LayersBelow::LayersBelow(const Connectivity& mesh, std::span<const Vector3> positions,
                         std::span<const TriangleArea> areas, std::span<const double> thickness,
                         std::span<const std::uint8_t> asked)
    : mesh_(mesh), x_(positions), areas_(areas), thickness_(thickness), near_(areas.size()) {
  if (std::ranges::none_of(asked, [](std::uint8_t flag) { return flag != 0; }))
    return;
  std::vector<Box> boxes(areas.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      boxes[t].add(x_[v], reach / 2 * thickness_[t]);
  BoxTree tree;
  tree.build(std::vector<QuickBox>(boxes.begin(), boxes.end()));
  std::vector<std::vector<std::array<std::uint32_t, 2>>> pairs(tree.chunks());
  tree.for_overlaps(asked, [&](std::size_t chunk, std::uint32_t i, std::uint32_t j) {
    if (boxes[i].overlaps(boxes[j]) && areas[i].area > 0 && areas[j].area > 0 &&
        std::abs(areas[i].normal.dot(areas[j].normal)) >= facing)
      pairs[chunk].push_back({i, j});
  });
  for (const auto& chunk : pairs)
    for (const auto& [i, j] : chunk) {
      near_[i].push_back(j);
      near_[j].push_back(i);
    }
  for (auto& near : near_)
    std::ranges::sort(near);
}

LyingOn LayersBelow::nearest(std::uint32_t t, double side) const {
  LyingOn on{nearest_of(all(t, side))};
  double area = 0;
  for (const Lying& l : on.parts)
    area += l.part;
  for (Lying& l : on.parts)
    l.part /= area;
  on.covered = area / areas_[t].area;
  return on;
}

LyingOn LayersBelow::beside(std::uint32_t t, const LyingOn& neighbour) const {
  const Corners& own = mesh_.triangles[t];
  const auto near = [&](std::uint32_t v, std::uint32_t lower) {
    const Corners& c = mesh_.triangles[lower];
    return closest_vertex_triangle({x_[v], x_[c[0]], x_[c[1]], x_[c[2]]}).offset.norm() <=
           reach / 2 * (thickness_[t] + thickness_[lower]);
  };
  for (const std::uint32_t v : own)
    if (std::ranges::none_of(neighbour.parts, [&](const Lying& l) { return near(v, l.lower); }))
      return {};
  LyingOn on{neighbour.parts, 0};
  const Vector3 middle = (x_[own[0]] + x_[own[1]] + x_[own[2]]) / 3;
  for (Lying& l : on.parts) {
    const double height = l.normal.dot(middle - x_[mesh_.triangles[l.lower][0]]);
    if (l.lower == t || height < least_height * l.gap) // it is the layer below itself
      return {};
    l.upper = t;
    l.gap = height;
  }
  return on;
}

// Parts are areas here [m²].
std::vector<Lying> LayersBelow::all(std::uint32_t t, double side) const {
  const Vector3& normal = areas_[t].normal;
  const PlaneFrame plane(normal);
  const auto flat = [&](std::uint32_t of) {
    const Corners& c = mesh_.triangles[of];
    return FlatTriangle{plane.flat(x_[c[0]]), plane.flat(x_[c[1]]), plane.flat(x_[c[2]])};
  };
  const FlatTriangle own = flat(t);
  const double level = normal.dot(x_[mesh_.triangles[t][0]]);
  std::vector<Lying> all;
  for (const std::uint32_t other : near_[t]) {
    const Vector3& its_normal = areas_[other].normal;
    const double cosine = normal.dot(its_normal);
    const Overlap overlap = overlap_of(own, flat(other));
    if (overlap.area == 0)
      continue;
    const Vector3 middle = level * normal + overlap.middle[0] * plane.first + overlap.middle[1] * plane.second;
    const double height = its_normal.dot(x_[mesh_.triangles[other][0]] - middle); // from here to the other one
    if (side * height / cosine > 0 && std::abs(height) <= reach / 2 * (thickness_[t] + thickness_[other]))
      all.push_back({t, other, overlap.area, std::abs(height), -std::copysign(1.0, height) * its_normal});
  }
  return all;
}

// Of the sets that hang together, the one that is nearest on the average.
std::vector<Lying> LayersBelow::nearest_of(const std::vector<Lying>& all) const {
  DisjointSets sets(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (share_corner(all[i].lower, all[j].lower))
        sets.join(i, j);
  const std::vector<std::uint64_t> layer = sets.take();
  std::vector<double> area(all.size(), 0), moment(all.size(), 0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    area[layer[i]] += all[i].part;
    moment[layer[i]] += all[i].part * all[i].gap;
  }
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (layer[i] == i && moment[i] * area[nearest] < moment[nearest] * area[i])
      nearest = i;
  std::vector<Lying> chosen;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (layer[i] == nearest)
      chosen.push_back(all[i]);
  return chosen;
}

bool LayersBelow::share_corner(std::uint32_t a, std::uint32_t b) const {
  return std::ranges::any_of(mesh_.triangles[a], [&](std::uint32_t v) {
    return std::ranges::find(mesh_.triangles[b], v) != mesh_.triangles[b].end();
  });
}

} // namespace sheet::flow
