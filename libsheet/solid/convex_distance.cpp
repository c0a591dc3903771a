// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solid/convex_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "libsheet/solid/triangle_distance.h"
#include "libsheet/solid/triangle_part.h"

namespace sheet::solid {
namespace {

// A tolerance that halving can reach with these coordinates.
double reachable(double tolerance, const Triangle3& t) {
  return std::max(tolerance, 1e-13 * std::max({t[0].norm(), t[1].norm(), t[2].norm()}));
}

// Evaluations after which a search is a long one; short ones are as quick without what follows.
constexpr int patience = 500;

// Tangent planes of the distance that a long search has met. Each lies below the distance everywhere, and so does any
// mean of two. Where a part of a triangle lies across an edge of the solid, a plane of its own bounds it only once it
// is as small as it is near; those of two such parts, one on each side of the edge, together bound all along the edge.
class Tangents {
public:
  // Whether one or two of them keep all of the corners at this distance. Those that did last are asked first.
  template <std::size_t N> [[nodiscard]] bool keep(const std::array<Vector3, N>& corners, double distance) {
    std::array<std::array<double, N>, most> beyond;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t c = 0; c < N; ++c)
        beyond[i][c] = planes_[i].normal.dot(corners[c]) - planes_[i].offset - distance;
      for (std::size_t j = 0; j <= i; ++j)
        if (mean_is_positive(beyond[i], beyond[j])) {
          to_front(i);
          to_front(j < i ? j + 1 : j);
          return true;
        }
    }
    return false;
  }

  void add(const Vector3& x, const Near& near) {
    count_ = std::min(count_ + 1, most);
    to_front(count_ - 1);
    planes_.front() = {near.normal, near.normal.dot(x) - near.distance};
  }

private:
  static constexpr std::size_t most = 8;

  struct Plane {
    Vector3 normal;
    double offset;
  };

  // Whether, with some weight, the mean of the two is nowhere negative.
  template <std::size_t N>
  static bool mean_is_positive(const std::array<double, N>& a, const std::array<double, N>& b) {
    double least = 0, largest = 1; // weight of a
    for (std::size_t c = 0; c < N; ++c) {
      if (a[c] < 0 && b[c] < 0)
        return false;
      if (a[c] < 0)
        largest = std::min(largest, b[c] / (b[c] - a[c]));
      else if (b[c] < 0)
        least = std::max(least, b[c] / (b[c] - a[c]));
    }
    return least <= largest;
  }

  void to_front(std::size_t i) {
    const auto at = planes_.begin() + static_cast<std::ptrdiff_t>(i);
    std::rotate(planes_.begin(), at, std::next(at));
  }

  std::array<Plane, most> planes_;
  std::size_t count_ = 0;
};

// The point of a triangle where the signed distance is least, by projected gradients with steps of Barzilai and Borwein
// [1988] from the triangle's middle: a convex function, so that neither the order of the corners nor where a search has
// stopped matters. Less than exact inside a solid whose surface has edges.
TrianglePoint lowest_point(const SolidDistance& shape, const Triangle3& triangle) {
  constexpr int most_steps = 400;
  constexpr double done = 1e-9, grows = 4, shrinks = 0.25; // of the longest side; of a step from one to the next
  const double side = longest_side(triangle).length;
  TrianglePoint best{middle(whole_triangle), {}};
  Vector3 x = point_of(triangle, best.weights);
  best.near = shape.nearest(x);
  double length = side;
  for (int step = 0; step < most_steps && length > done * side; ++step) {
    const NearestOnTriangle next = nearest_on_triangle(x - length * best.near.normal, triangle);
    const Vector3 way = next.point - x;
    if (way.norm() <= done * side)
      break;
    const Near near = shape.nearest(next.point);
    const double bend = way.dot(near.normal - best.near.normal), longest = grows * length;
    if (!(near.distance < best.near.distance)) {
      length *= shrinks;
      continue;
    }
    length = bend * longest > way.squaredNorm() ? way.squaredNorm() / bend : longest;
    x = next.point;
    best = {next.weights, near};
  }
  return best;
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
    return settled();
  }

private:
  // Until s_ all is clear; when it comes within the clearance itself, and where, or that it does not: whatever order
  // the search went in. Conservative advancement from lowest point to lowest point, whose tangent planes tell how long
  // all is clear; where that gains next to nothing, such as along a surface, it is the hit.
  [[nodiscard]] std::optional<TriangleHit> settled() const {
    constexpr int turns = 100;
    constexpr double exact = 1e-9; // of the clearance
    double s = s_;
    for (int turn = 0;; ++turn) {
      const Triangle3 now = triangle_.at(s);
      const TrianglePoint lowest = lowest_point(shape_, now);
      const double next = clear_until(s, point_of(now, lowest.weights), lowest.near);
      if (lowest.near.distance <= clearance_ * (1 + exact) || turn == turns || next == s)
        return TriangleHit{s, lowest};
      if (next >= 1)
        return std::nullopt;
      s = next;
    }
  }

  // Until when the tangent plane at x keeps all corners clear; infinity if it always does.
  [[nodiscard]] double clear_until(double s, const Vector3& x, const Near& near) const {
    const Triangle3 now = triangle_.at(s);
    double until = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const double above = near.distance - clearance_ + near.normal.dot(now[i] - x);
      const double closing = near.normal.dot(triangle_.start[i] - triangle_.end[i]);
      if (above <= 0)
        return s;
      if (closing > 0)
        until = std::min(until, s + above / closing);
    }
    return until;
  }

  void search(const TrianglePart& part, double from, double to) {
    if (found_ && from >= s_)
      return;
    const bool is_long = ++evaluations_ > patience;
    if (is_long)
      to = std::min(to, s_);
    const Triangle3 before = place(part, triangle_.at(from)), after = place(part, triangle_.at(to));
    if (is_long && tangents_.keep<6>({before[0], before[1], before[2], after[0], after[1], after[2]}, clearance_))
      return;
    const Vector3 center = point_of(triangle_.at((from + to) / 2), middle(part));
    const Near near = shape_.nearest(center);
    if (is_long)
      tangents_.add(center, near);
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
      return;
    }
    if (is_long && advance(part, center, near, from, to))
      return;
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

  // In a long search, from when a corner may be near by the tangent plane: there it is, or the rest of the time is
  // searched, or little is gained (false). [conservative advancement, Mirtich 1996]
  bool advance(const TrianglePart& part, const Vector3& center, const Near& near, double from, double to) {
    double first = to;
    std::size_t corner = 0;
    const Triangle3 before = place(part, triangle_.at(from)), after = place(part, triangle_.at(to));
    for (std::size_t i = 0; i < 3; ++i) {
      const double above = near.distance + near.normal.dot(before[i] - center) - clearance_;
      const double below = near.distance + near.normal.dot(after[i] - center) - clearance_;
      const double s = above <= 0 ? from : below < 0 ? from + (to - from) * (above / (above - below)) : to;
      if (s < first) {
        first = s;
        corner = i;
      }
    }
    if (first >= s_)
      return true;
    if (const Vector3 x = point_of(triangle_.at(first), part[corner]);
        shape_.nearest(x).distance <= clearance_ + tolerance_) {
      found_ = true;
      s_ = first;
      return true;
    }
    if (first <= from || first - from < (to - from) / 4) // an instant has no rest to be searched
      return false;
    search(part, first, to);
    return true;
  }

  const SolidDistance& shape_;
  const MovingTriangle& triangle_;
  double clearance_, tolerance_;
  int evaluations_ = 0;
  Tangents tangents_;
  bool found_ = false;
  double s_ = 1;
};

// The least signed distance over a triangle, or of what is below `enough`; one that is not above `low` will do.
class DepthSearch {
public:
  DepthSearch(const SolidDistance& shape, const Triangle3& triangle, double enough, double tolerance,
              double low = -std::numeric_limits<double>::infinity())
      : shape_(shape), triangle_(triangle), best_{{}, {enough, Vector3::Zero()}},
        tolerance_(reachable(tolerance, triangle)), low_(low) {
    search(whole_triangle);
  }

  [[nodiscard]] const TrianglePoint& best() const { return best_; }

private:
  void search(const TrianglePart& part) {
    if (best_.near.distance <= low_)
      return;
    const Triangle3 corners = place(part, triangle_);
    const bool is_long = ++evaluations_ > patience;
    if (is_long && tangents_.keep(corners, best_.near.distance - tolerance_))
      return;
    const Weights weights = middle(part);
    const Vector3 center = point_of(triangle_, weights);
    const Near near = shape_.nearest(center);
    try_point(weights, near);
    double lowest = 0;
    std::size_t lowest_corner = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (const double below = near.normal.dot(corners[i] - center); below < lowest) {
        lowest = below;
        lowest_corner = i;
      }
    if (is_long) {
      tangents_.add(center, near);
      try_point(part[lowest_corner], shape_.nearest(corners[lowest_corner]));
    }
    if (near.distance + lowest >= best_.near.distance - tolerance_ || radius_around(center, corners) <= tolerance_)
      return;
    for (const TrianglePart& half : halves(part, longest_side(corners).opposite))
      search(half);
  }

  void try_point(const Weights& weights, const Near& near) {
    if (near.distance < best_.near.distance)
      best_ = {weights, near};
  }

  const SolidDistance& shape_;
  const Triangle3& triangle_;
  TrianglePoint best_;
  double tolerance_, low_;
  int evaluations_ = 0;
  Tangents tangents_;
};

} // namespace

std::optional<TriangleHit> ConvexDistance::first_hit(const MovingTriangle& triangle, double clearance,
                                                     double tolerance) const {
  return HitSearch(*this, triangle, clearance, tolerance).first();
}

double ConvexDistance::separation(const Triangle3& triangle, double enough, double tolerance) const {
  const double least = DepthSearch(*this, triangle, enough + tolerance, tolerance, tolerance).best().near.distance;
  return std::max(0.0, least - tolerance);
}

TrianglePoint ConvexDistance::deepest(const Triangle3& triangle, double tolerance) const {
  constexpr double fine_enough = 1e-4; // of the longest side: what is across the edge of a box has as many parts
  const TrianglePoint lowest = lowest_point(*this, triangle);
  const double within = std::max(tolerance, fine_enough * longest_side(triangle).length);
  const DepthSearch search(*this, triangle, lowest.near.distance, within);
  return search.best().near.distance < lowest.near.distance - within ? search.best() : lowest;
}

} // namespace sheet::solid
