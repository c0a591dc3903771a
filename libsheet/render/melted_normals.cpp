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

// Of vectors, by component; lengths in radii.
using Columns = std::array<std::vector<float>, 3>;

// Parts in the order of the cells of a grid, so that those of three or more cells in a row stand in one piece.
class Cells {
public:
  Cells(const std::vector<Part>& parts, double radius) : radius_(radius) {
    std::vector<std::pair<Cell, std::uint32_t>> order;
    for (std::uint32_t p = 0; p < parts.size(); ++p)
      order.emplace_back(cell_of(parts[p].place, radius / in_a_radius), p);
    std::sort(order.begin(), order.end());
    if (!parts.empty())
      origin_ = parts.front().place;
    for (const auto& [cell, p] : order) {
      cells_.push_back(cell);
      weight_.push_back(parts[p].weight);
      for (int axis = 0; axis < 3; ++axis) {
        place_[static_cast<std::size_t>(axis)].push_back(in_radii(parts[p].place)[axis]);
        normal_[static_cast<std::size_t>(axis)].push_back(parts[p].normal[axis]);
      }
    }
  }

  // Σ weight max(0, own · n) (1 - d²)² n of all parts that are d < 1 radii away.
  [[nodiscard]] Vec mean_around(const Vector3& x, const Vec& own) const {
    const Cell c = cell_of(x, radius_ / in_a_radius);
    const Vec place = in_radii(x);
    Lanes sum{};
    for (std::int64_t i = c[0] - in_a_radius; i <= c[0] + in_a_radius; ++i)
      for (std::int64_t j = c[1] - in_a_radius; j <= c[1] + in_a_radius; ++j) {
        const double square = square_beyond(x.x(), i) + square_beyond(x.y(), j);
        if (square >= radius_ * radius_)
          continue;
        const double half = std::sqrt(radius_ * radius_ - square);
        const std::int64_t low = cell_of(x - half * Vector3::UnitZ(), radius_ / in_a_radius)[2],
                           high = cell_of(x + half * Vector3::UnitZ(), radius_ / in_a_radius)[2];
        const auto begin = std::ranges::lower_bound(cells_, Cell{i, j, low});
        const auto end = std::lower_bound(begin, cells_.end(), Cell{i, j, high + 1});
        add(begin - cells_.begin(), end - cells_.begin(), place, own, sum);
      }
    Vec total = Vec::Zero();
    for (std::size_t lane = 0; lane < lanes; ++lane)
      total += Vec(sum[0][lane], sum[1][lane], sum[2][lane]);
    return total;
  }

private:
  static constexpr std::int64_t in_a_radius = 2; // cells
  static constexpr std::size_t lanes = 8;        // sums beside each other, for the compiler to make vectors of
  using Lanes = std::array<std::array<float, lanes>, 3>;

  // Of the way from a coordinate to the cells of that number [m²].
  [[nodiscard]] double square_beyond(double x, std::int64_t cell) const {
    const double size = radius_ / in_a_radius, low = static_cast<double>(cell) * size;
    return std::pow(std::max({0.0, low - x, x - (low + size)}), 2);
  }
  [[nodiscard]] Vec in_radii(const Vector3& x) const { return ((x - origin_) / radius_).cast<float>(); }

  void add_one(std::size_t p, std::size_t lane, const Vec& place, const Vec& own, Lanes& sum) const {
    const float x = place_[0][p] - place[0], y = place_[1][p] - place[1], z = place_[2][p] - place[2];
    const float near = std::max(0.0F, 1 - (x * x + y * y + z * z));
    const float alike = own[0] * normal_[0][p] + own[1] * normal_[1][p] + own[2] * normal_[2][p];
    const float part = weight_[p] * std::max(0.0F, alike) * near * near;
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum[axis][lane] += part * normal_[axis][p];
  }
  void add(std::ptrdiff_t begin, std::ptrdiff_t end, const Vec& place, const Vec& own, Lanes& sum) const {
    auto p = static_cast<std::size_t>(begin);
    for (; p + lanes <= static_cast<std::size_t>(end); p += lanes)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        add_one(p + lane, lane, place, own, sum);
    for (; p < static_cast<std::size_t>(end); ++p)
      add_one(p, 0, place, own, sum);
  }

  double radius_;
  Vector3 origin_ = Vector3::Zero();
  std::vector<Cell> cells_; // of each part
  std::vector<float> weight_;
  Columns place_, normal_;
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

std::vector<Vec> melted_normals(const Surface& surface, const std::vector<float>& closeness,
                                const std::vector<float>& covered, double radius) {
  std::vector<Vec> result = surface.normals;
  constexpr double fineness = 6; // cells of a gathered part in the radius
  const Cells cells(gathered(bare_parts(surface, covered), radius / fineness), radius);
  const std::vector<float> area = areas(surface);
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t p) {
    const float close = closeness[surface.source_vertex[p]];
    if (!(close > 0))
      return;
    const Vec& own = surface.normals[p];
    const Vec sum = area[p] * own + cells.mean_around(surface.positions[p], own);
    if (sum.norm() > 0)
      result[p] = ((1 - close) * own + close * sum.normalized()).normalized();
  });
  return result;
}

} // namespace sheet::render
