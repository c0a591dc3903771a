// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/solid_distance.h"

#include <queue>

namespace sheet::collide {
namespace {

// A part of the triangle with its middle's distance; what it may hide at best comes first.
struct Part {
  std::array<std::array<double, 3>, 3> corners;
  double least;
  bool operator<(const Part& other) const { return least > other.least; }
};

} // namespace

// The signed distance changes no faster than 1, so a part hides nothing below its middle's value less its radius.
TrianglePoint SolidDistance::deepest(const Triangle3& triangle, double tolerance) const {
  constexpr int kEvaluations = 4096;
  TrianglePoint best{{}, {std::numeric_limits<double>::infinity(), Vector3::Zero()}};
  std::priority_queue<Part> parts;
  int evaluations = 0;
  const auto look_at = [&](const std::array<std::array<double, 3>, 3>& corners) {
    std::array<double, 3> middle;
    for (std::size_t i = 0; i < 3; ++i)
      middle[i] = (corners[0][i] + corners[1][i] + corners[2][i]) / 3;
    const Vector3 center = point_of(triangle, middle);
    const Near near = nearest(center);
    ++evaluations;
    if (near.distance < best.near.distance)
      best = {middle, near};
    double radius = 0;
    for (const auto& corner : corners)
      radius = std::max(radius, (point_of(triangle, corner) - center).norm());
    parts.push({corners, near.distance - radius});
  };
  look_at({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  while (!parts.empty() && parts.top().least < best.near.distance - tolerance && evaluations < kEvaluations) {
    const auto [a, b, c] = parts.top().corners;
    parts.pop();
    const auto mean = [](const std::array<double, 3>& p, const std::array<double, 3>& q) {
      return std::array<double, 3>{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
    };
    const auto ab = mean(a, b), bc = mean(b, c), ca = mean(c, a);
    look_at({a, ab, ca});
    look_at({ab, b, bc});
    look_at({ca, bc, c});
    look_at({ab, bc, ca});
  }
  return best;
}

} // namespace sheet::collide
