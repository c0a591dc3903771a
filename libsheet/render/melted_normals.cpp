// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/render/melted_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <tbb/parallel_for.h>

namespace sheet::render {
namespace {

using Cell = std::array<std::int64_t, 3>;

// A triangle of the surface.
struct Part {
  Vector3 place;
  Vec normal;
  float weight; // its area, as far as it is bare
};

std::vector<Part> bare_parts(const Surface& s, const std::vector<float>& covered) {
  std::vector<Part> parts;
  for (const auto& [a, b, c] : s.triangles) {
    const Vector3& x = s.positions[a];
    const double area = 0.5 * (s.positions[b] - x).cross(s.positions[c] - x).norm();
    const float bare = 1 - (covered[a] + covered[b] + covered[c]) / 3;
    const Vec normal = s.normals[a] + s.normals[b] + s.normals[c];
    if (area > 0 && bare > 0 && normal.norm() > 0)
      parts.push_back(
          {(x + s.positions[b] + s.positions[c]) / 3, normal.normalized(), static_cast<float>(area) * bare});
  }
  return parts;
}

Cell cell_of(const Vector3& x, double size) {
  const auto at = [&](double v) { return static_cast<std::int64_t>(std::floor(v / size)); };
  return {at(x.x()), at(x.y()), at(x.z())};
}

// Of the six directions along the axes, the one that it faces most.
int facing(const Vec& normal) {
  Vec::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(2 * axis) + (normal[axis] < 0 ? 1 : 0);
}

// One part for those in each cell of a grid that face the same way: so the work does not grow with the square of how
// fine the triangles are.
std::vector<Part> gathered(const std::vector<Part>& parts, double size) {
  std::vector<std::tuple<Cell, int, std::uint32_t>> order;
  for (std::uint32_t p = 0; p < parts.size(); ++p)
    order.emplace_back(cell_of(parts[p].place, size), facing(parts[p].normal), p);
  std::sort(order.begin(), order.end());
  std::vector<Part> result;
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    Part sum{Vector3::Zero(), Vec::Zero(), 0};
    for (end = i; end < order.size() && std::get<0>(order[end]) == std::get<0>(order[i]) &&
                  std::get<1>(order[end]) == std::get<1>(order[i]);
         ++end) {
      const Part& part = parts[std::get<2>(order[end])];
      sum.place += static_cast<double>(part.weight) * part.place;
      sum.normal += part.weight * part.normal;
      sum.weight += part.weight;
    }
    result.push_back({sum.place / static_cast<double>(sum.weight), sum.normal.normalized(), sum.weight});
  }
  return result;
}

// Parts in cells of a grid, in the order of the cells.
class Cells {
public:
  Cells(const std::vector<Part>& parts, double size) : size_(size) {
    for (std::uint32_t p = 0; p < parts.size(); ++p)
      points_.emplace_back(cell_of(parts[p].place, size), p);
    std::sort(points_.begin(), points_.end());
  }

  // Calls visit(part) for all parts in the cells around x.
  template <class Visit> void around(const Vector3& x, Visit&& visit) const {
    const Cell c = cell_of(x, size_);
    for (std::int64_t i = c[0] - 1; i <= c[0] + 1; ++i)
      for (std::int64_t j = c[1] - 1; j <= c[1] + 1; ++j) { // three cells in a row
        const auto end = std::pair(Cell{i, j, c[2] + 2}, 0U);
        for (auto p = std::lower_bound(points_.begin(), points_.end(), std::pair(Cell{i, j, c[2] - 1}, 0U));
             p != points_.end() && *p < end; ++p)
          visit(p->second);
      }
  }

private:
  double size_;
  std::vector<std::pair<Cell, std::uint32_t>> points_;
};

// A third of the triangles around each point.
std::vector<float> areas(const Surface& s) {
  std::vector<float> result(s.positions.size());
  for (const Corners& t : s.triangles) {
    const Vector3& x = s.positions[t[0]];
    const double area = 0.5 * (s.positions[t[1]] - x).cross(s.positions[t[2]] - x).norm();
    for (const std::uint32_t p : t)
      result[p] += static_cast<float>(area / 3);
  }
  return result;
}

} // namespace

std::vector<Vec> melted_normals(const Surface& surface, const NearLayers& near, double radius) {
  std::vector<Vec> result = surface.normals;
  constexpr double fineness = 6; // cells of a gathered part in the radius
  const std::vector<Part> parts = gathered(bare_parts(surface, near.covered), radius / fineness);
  const Cells cells(parts, radius);
  const std::vector<float> area = areas(surface);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t p) {
    const float closeness = near.closeness[surface.source_vertex[p]];
    if (!(closeness > 0))
      return;
    const Vec& own = surface.normals[p];
    Vec sum = area[p] * own;
    cells.around(surface.positions[p], [&](std::uint32_t q) {
      const double square = (parts[q].place - surface.positions[p]).squaredNorm() / (radius * radius);
      const float alike = own.dot(parts[q].normal);
      if (square < 1 && alike > 0)
        sum += parts[q].weight * alike * static_cast<float>((1 - square) * (1 - square)) * parts[q].normal;
    });
    if (sum.norm() > 0)
      result[p] = ((1 - closeness) * own + closeness * sum.normalized()).normalized();
  });
  return result;
}

} // namespace sheet::render
