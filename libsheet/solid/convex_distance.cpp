// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/convex_distance.h"

#include <algorithm>
#include <cmath>

#include "libsheet/solid/triangle_part.h"

namespace sheet::solid {
namespace {

// A tolerance that halving can reach with these coordinates.
double reachable(double tolerance, const Triangle3& t) {
  return std::max(tolerance, 1e-13 * std::max({t[0].norm(), t[1].norm(), t[2].norm()}));
}

class HitSearch {
public:
  HitSearch(const SolidDistance& shape, const MovingTriangle& triangle, double clearance, double tolerance)
      : shape_(shape), triangle_(triangle), clearance_(clearance),
        tolerance_(std::max(reachable(tolerance, triangle.start), reachable(tolerance, triangle.end))) {
    search(whole_triangle, 0, 1);
  }

  [[nodiscard]] std::optional<TriangleHit> first() const {
    if (!found_)
      return std::nullopt;
    return TriangleHit{s_, {weights_, shape_.nearest(point_of(triangle_.at(s_), weights_))}};
  }

private:
  void search(const TrianglePart& part, double from, double to) {
    if (found_ && from >= s_)
      return;
    const Triangle3 before = place(part, triangle_.at(from)), after = place(part, triangle_.at(to));
    const Vector3 center = point_of(triangle_.at((from + to) / 2), middle(part));
    const Near near = shape_.nearest(center);
    double lowest = 0, radius = 0, travel = 0, closing = 0, slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const Vector3& corner : {before[i], after[i]}) {
        lowest = std::min(lowest, near.normal.dot(corner - center));
        radius = std::max(radius, (corner - center).norm());
      }
      travel = std::max(travel, (after[i] - before[i]).norm());
      closing = std::max(closing, std::abs(near.normal.dot(after[i] - before[i])));
      for (const Triangle3* t : {&before, &after})
        slope = std::max(slope, std::abs(near.normal.dot((*t)[(i + 1) % 3] - (*t)[i])));
    }
    if (near.distance + lowest >= clearance_)
      return;
    if (radius <= tolerance_ || (travel <= tolerance_ && near.distance <= clearance_ + tolerance_ / 2)) {
      found_ = true;
      s_ = from;
      weights_ = middle(part);
      return;
    }
    // Cut what makes the bound vary more; along the surface a tenth counts, because there it is curved.
    const LongestSide a = longest_side(before), b = longest_side(after);
    const LongestSide side = a.length >= b.length ? a : b;
    if (closing + travel / 10 >= slope + side.length / 10) { // the earlier half first: what it finds spares the later
      search(part, from, (from + to) / 2);
      search(part, (from + to) / 2, to);
    } else {
      for (const TrianglePart& half : halves(part, side.opposite))
        search(half, from, to);
    }
  }

  const SolidDistance& shape_;
  const MovingTriangle& triangle_;
  double clearance_, tolerance_;
  bool found_ = false;
  double s_ = 1;
  Weights weights_{};
};

// The least signed distance over a triangle, or of what is below `enough`.
class DepthSearch {
public:
  DepthSearch(const SolidDistance& shape, const Triangle3& triangle, double enough, double tolerance)
      : shape_(shape), triangle_(triangle), best_{{}, {enough, Vector3::Zero()}},
        tolerance_(reachable(tolerance, triangle)) {
    search(whole_triangle);
  }

  [[nodiscard]] const TrianglePoint& best() const { return best_; }

private:
  void search(const TrianglePart& part) {
    const Triangle3 corners = place(part, triangle_);
    const Weights weights = middle(part);
    const Vector3 center = point_of(triangle_, weights);
    const Near near = shape_.nearest(center);
    if (near.distance < best_.near.distance)
      best_ = {weights, near};
    double lowest = 0;
    for (const Vector3& corner : corners)
      lowest = std::min(lowest, near.normal.dot(corner - center));
    if (near.distance + lowest >= best_.near.distance - tolerance_ || radius_around(center, corners) <= tolerance_)
      return;
    for (const TrianglePart& half : halves(part, longest_side(corners).opposite))
      search(half);
  }

  const SolidDistance& shape_;
  const Triangle3& triangle_;
  TrianglePoint best_;
  double tolerance_;
};

} // namespace

std::optional<TriangleHit> ConvexDistance::first_hit(const MovingTriangle& triangle, double clearance,
                                                     double tolerance) const {
  return HitSearch(*this, triangle, clearance, tolerance).first();
}

double ConvexDistance::separation(const Triangle3& triangle, double enough, double tolerance) const {
  const double least = DepthSearch(*this, triangle, enough + tolerance, tolerance).best().near.distance;
  return std::max(0.0, least - tolerance);
}

TrianglePoint ConvexDistance::deepest(const Triangle3& triangle, double tolerance) const {
  return DepthSearch(*this, triangle, std::numeric_limits<double>::infinity(), tolerance).best();
}

} // namespace sheet::solid
