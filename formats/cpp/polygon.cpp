// SPDX-License-Identifier: MIT
#include "formats/cpp/polygon.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sheet::formats {

namespace {

using Point = std::array<double, 3>;
using Flat = std::array<double, 2>;

constexpr double most_bent = 0.1;             // of the size, out of the plane
constexpr double rounding = 1e-12;            // of the size squared: smaller areas may be none
constexpr std::size_t most_corners = 1 << 13; // of what is not convex: it takes their square

// In units of its size, about its first corner, so that nothing overflows.
std::vector<Point> scaled(std::span<const Point> points, std::span<const std::uint32_t> corners) {
  double size = 0;
  for (const std::uint32_t c : corners)
    for (int d = 0; d < 3; ++d)
      size = std::max(size, std::abs(points[c][d] / 2 - points[corners[0]][d] / 2));
  std::vector<Point> x(corners.size(), Point{});
  for (std::size_t i = 0; size > 0 && i < corners.size(); ++i)
    for (int d = 0; d < 3; ++d)
      x[i][d] = (points[corners[i]][d] / 2 - points[corners[0]][d] / 2) / size;
  return x;
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Twice the polygon's area along its mean normal [Newell; Sutherland, Sproull and Schumacker 1974].
Point area_vector(const std::vector<Point>& x) {
  Point sum{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Point part = cross(x[i], x[(i + 1) % x.size()]);
    for (int d = 0; d < 3; ++d)
      sum[d] += part[d];
  }
  return sum;
}

bool in_a_line(const std::vector<Point>& x) {
  const auto& far = *std::ranges::max_element(x, {}, [](const Point& p) { return dot(p, p); });
  return std::ranges::all_of(x, [&](const Point& p) {
    const Point area = cross(far, p);
    return dot(area, area) <= rounding * rounding;
  });
}

// Coordinates in the plane across `normal`, a unit vector, right-handed with it.
std::vector<Flat> flattened(const std::vector<Point>& x, const Point& normal) {
  Point other{};
  other[std::ranges::min_element(normal, {}, [](double n) { return std::abs(n); }) - normal.begin()] = 1;
  Point u = cross(other, normal);
  const double length = std::sqrt(dot(u, u));
  for (double& component : u)
    component /= length;
  const Point v = cross(normal, u);
  std::vector<Flat> flat;
  for (const Point& p : x)
    flat.push_back({dot(u, p), dot(v, p)});
  return flat;
}

// Twice the area of a triangle, 0 where its sign is not sure.
double area(const Flat& a, const Flat& b, const Flat& c) {
  const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return std::abs(twice) > rounding ? twice : 0;
}

bool is_convex(const std::vector<Flat>& x) {
  const std::size_t n = x.size();
  std::size_t turns = 0; // how often the edges' direction comes round
  for (std::size_t i = 0; i < n; ++i) {
    const Flat &a = x[i], &b = x[(i + 1) % n], &c = x[(i + 2) % n];
    if (area(a, b, c) < 0 || (i > 0 && i + 1 < n && area(x[0], a, b) <= 0))
      return false;
    turns += b[1] < a[1] && c[1] >= b[1] ? 1 : 0;
  }
  return turns == 1;
}

bool cross_each_other(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
  return area(a, b, c) * area(a, b, d) < 0 && area(c, d, a) * area(c, d, b) < 0;
}

bool crosses_itself(const std::vector<Flat>& x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = i + 2; j < x.size(); ++j)
      if (cross_each_other(x[i], x[i + 1], x[j], x[(j + 1) % x.size()]))
        return true;
  return false;
}

// Clips ears, those of the best shape first, so that corners in a line with their neighbours find a triangle.
class EarClipping {
public:
  explicit EarClipping(const std::vector<Flat>& x) : x_(x) {
    for (std::uint32_t i = 0; i < x.size(); ++i)
      left_.push_back(i);
    for (std::size_t i = 0; i < left_.size(); ++i)
      quality_.push_back(quality(i));
  }

  // Places in the list of corners; nothing if no ear is left: it crosses itself.
  std::optional<std::vector<std::array<std::uint32_t, 3>>> triangles() {
    std::vector<std::array<std::uint32_t, 3>> result;
    while (left_.size() > 2) {
      const auto best = std::ranges::max_element(quality_);
      if (*best < 0)
        return {};
      const auto i = static_cast<std::size_t>(best - quality_.begin());
      if (*best > 0)
        result.push_back({before(i), left_[i], after(i)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
      quality_.erase(best);
      for (const std::size_t neighbour : {i % left_.size(), (i + left_.size() - 1) % left_.size()})
        quality_[neighbour] = quality(neighbour);
    }
    return result;
  }

private:
  [[nodiscard]] std::uint32_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  [[nodiscard]] std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

  // Of the triangle that would be clipped at this corner; 0 for the tip of a way there and back, -1 for what is no ear.
  [[nodiscard]] double quality(std::size_t i) const {
    const Flat &a = x_[before(i)], &b = x_[left_[i]], &c = x_[after(i)];
    const double twice = area(a, b, c);
    if (twice <= 0)
      return a == c ? 0 : -1;
    for (const std::uint32_t k : left_) {
      const Flat& p = x_[k];
      if (p != a && p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0)
        return -1;
    }
    const auto squared = [](const Flat& p, const Flat& q) {
      return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    };
    return twice / (squared(a, b) + squared(b, c) + squared(c, a));
  }

  const std::vector<Flat>& x_;
  std::vector<std::uint32_t> left_; // corners not yet clipped
  std::vector<double> quality_;     // of each of them
};

PolygonTriangles fan(std::span<const std::uint32_t> corners) {
  PolygonTriangles result;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    result.triangles.push_back({corners[0], corners[i], corners[i + 1]});
  return result;
}

} // namespace

PolygonTriangles triangulate(std::span<const Point> points, std::span<const std::uint32_t> corners) {
  const std::vector<Point> x = scaled(points, corners);
  if (corners.size() == 3 || in_a_line(x))
    return fan(corners);
  Point normal = area_vector(x);
  const double length = std::sqrt(dot(normal, normal));
  if (!(length > rounding))
    return {{}, "crosses itself"};
  double low = 0, high = 0;
  for (double& component : normal)
    component /= length;
  for (const Point& p : x) {
    low = std::min(low, dot(normal, p));
    high = std::max(high, dot(normal, p));
  }
  if (corners.size() > 4 && high - low > most_bent)
    return {{}, "is not flat"};
  const std::vector<Flat> flat = flattened(x, normal);
  if (is_convex(flat))
    return fan(corners);
  if (corners.size() > most_corners)
    return {{}, "is not convex and has too many corners"};
  const auto ears = crosses_itself(flat) ? std::nullopt : EarClipping(flat).triangles();
  if (!ears)
    return {{}, "crosses itself"};
  PolygonTriangles result;
  for (const auto& [a, b, c] : *ears)
    result.triangles.push_back({corners[a], corners[b], corners[c]});
  return result;
}

} // namespace sheet::formats
