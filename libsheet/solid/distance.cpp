// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/distance.h"

#include <queue>

#include "libsheet/solid/triangle_part.h"

namespace sheet::solid {
namespace {

// What a part may hide at best.
struct Hiding {
  TrianglePart part;
  double least;
  bool operator<(const Hiding& other) const { return least > other.least; } // the least comes first
};

} // namespace

// The signed distance changes no faster than 1, so a part hides nothing below its middle's value less its radius.
TrianglePoint SolidDistance::deepest(const Triangle3& triangle, double tolerance) const {
  constexpr int most_evaluations = 4096;
  TrianglePoint best{{}, {std::numeric_limits<double>::infinity(), Vector3::Zero()}};
  std::priority_queue<Hiding> queue;
  int evaluations = 0;
  const auto look_at = [&](const TrianglePart& part) {
    const Weights weights = middle(part);
    const Vector3 center = point_of(triangle, weights);
    const Near near = nearest(center);
    ++evaluations;
    if (near.distance < best.near.distance)
      best = {weights, near};
    queue.push({part, near.distance - radius_around(center, place(part, triangle))});
  };
  look_at(whole_triangle);
  while (queue.top().least < best.near.distance - tolerance && evaluations < most_evaluations) {
    const TrianglePart part = queue.top().part;
    queue.pop();
    for (const TrianglePart& half : halves(part, longest_side(place(part, triangle)).opposite))
      look_at(half);
  }
  return best;
}

} // namespace sheet::solid
