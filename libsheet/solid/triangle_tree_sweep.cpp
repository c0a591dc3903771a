// SPDX-License-Identifier: GPL-3.0-or-later
// Moving triangles against the tree. Boxes and triangles that some direction separates from the whole sweep are passed
// over; what remains is settled pair by pair by conservative advancement along the direction between the nearest points
// [Mirtich 1996]: two convex bodies stay apart in that direction until the fastest corner has used up the gap.
#include <algorithm>

#include "libsheet/solid/triangle_distance.h"
#include "libsheet/solid/triangle_part.h"
#include "libsheet/solid/triangle_tree.h"

namespace sheet::solid {
namespace {

// Turns of advancement before a triangle is halved.
constexpr int turns = 4;

// The convex hull of a triangle's sweep, as shadows on some directions: the axes, the triangle's normals at both ends,
// and the normals of the sweep's sides.
class Prism {
public:
  explicit Prism(const MovingTriangle& moving) {
    Vector3 travel = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      travel += moving.end[i] - moving.start[i];
    std::size_t count = 0;
    const auto add = [&](const Vector3& direction) {
      const Vector3 unit = direction.stableNormalized();
      if (!(unit.squaredNorm() > 0.5)) // no direction at all
        return;
      Shadow& s = shadows_[count++];
      s = {unit, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
      for (const Triangle3* t : {&moving.start, &moving.end})
        for (const Vector3& x : *t) {
          s.low = std::min(s.low, unit.dot(x));
          s.high = std::max(s.high, unit.dot(x));
        }
    };
    for (int axis = 0; axis < 3; ++axis)
      add(Vector3::Unit(axis));
    for (const Triangle3* t : {&moving.start, &moving.end})
      add(((*t)[1] - (*t)[0]).cross((*t)[2] - (*t)[0]));
    for (std::size_t i = 0; i < 3; ++i)
      add(travel.cross(moving.start[(i + 1) % 3] - moving.start[i]));
    count_ = count;
  }

  [[nodiscard]] bool apart(const Box3& box, double clearance) const {
    const Vector3 center = box.center(), half = box.sizes() / 2;
    for (int axis = 0; axis < 3; ++axis) // the first three directions
      if (beside(shadows_[static_cast<std::size_t>(axis)], center[axis], half[axis] + clearance))
        return true;
    for (std::size_t i = 3; i < count_; ++i)
      if (const Shadow& s = shadows_[i];
          beside(s, s.direction.dot(center), s.direction.cwiseAbs().dot(half) + clearance))
        return true;
    return false;
  }

  [[nodiscard]] bool apart(const Triangle3& t, double clearance) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const Shadow& s = shadows_[i];
      const double a = s.direction.dot(t[0]), b = s.direction.dot(t[1]), c = s.direction.dot(t[2]);
      if (std::min({a, b, c}) - clearance >= s.high || std::max({a, b, c}) + clearance <= s.low)
        return true;
    }
    return false;
  }

private:
  struct Shadow {
    Vector3 direction;
    double low, high;
  };
  static bool beside(const Shadow& s, double at, double reach) { return at - reach >= s.high || at + reach <= s.low; }

  std::array<Shadow, 8> shadows_;
  std::size_t count_ = 0;
};

class Advance {
public:
  Advance(const MovingTriangle& moving, double clearance, double tolerance)
      : moving_(moving), clearance_(clearance), tolerance_(tolerance) {}

  // The time of the earliest hit so far; 1 if there is none.
  [[nodiscard]] double until() const { return until_; }
  [[nodiscard]] const std::optional<TriangleHit>& hit() const { return hit_; }

  // Each turn advances by at least tolerance / travel, and halving ends at the tolerance, so this ends.
  void against(const Triangle3& other, const Vector3& face, const TrianglePart& part = whole_triangle, double s = 0) {
    const Triangle3 first = place(part, moving_.start), last = place(part, moving_.end);
    for (int turn = 1; s < until_; ++turn) {
      const Triangle3 now = place(part, moving_.at(s));
      const TrianglePair pair = nearest_points(now, other);
      const Vector3 direction = pair.distance > 0 ? Vector3((pair.first - pair.second) / pair.distance) : face;
      const double gap = pair.distance - clearance_;
      double approach = 0, nearest_approach = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double closing = direction.dot(first[i] - last[i]);
        approach = std::max(approach, closing);
        nearest_approach += pair.weights[i] * closing;
      }
      // Nearer than the tolerance, or than round-off allows.
      if (gap <= tolerance_ || (approach > 0 && s + gap / approach == s)) {
        until_ = s;
        hit_ = TriangleHit{s, {in_whole(part, pair.weights), {pair.distance, direction}}};
        return;
      }
      if ((until_ - s) * approach <= gap)
        return;
      s += gap / approach;
      // One corner rests near the other triangle while others race: each half goes on by itself.
      if (turn >= turns && nearest_approach < approach / 2) {
        const LongestSide before = longest_side(first), after = longest_side(last);
        const LongestSide side = before.length >= after.length ? before : after;
        if (side.length <= tolerance_)
          continue;
        for (const TrianglePart& half : halves(part, side.opposite))
          against(other, face, half, s);
        return;
      }
    }
  }

private:
  const MovingTriangle& moving_;
  double clearance_, tolerance_;
  double until_ = 1;
  std::optional<TriangleHit> hit_;
};

} // namespace

std::optional<TriangleHit> TriangleTree::first_hit(const MovingTriangle& moving, double clearance,
                                                   double tolerance) const {
  Advance advance(moving, clearance, tolerance);
  Prism prism(moving);
  const double reach = clearance + tolerance;
  const Vector3 center = (moving.start[0] + moving.start[1] + moving.start[2]) / 3;
  std::array<std::uint32_t, 64> stack;
  std::size_t height = 0;
  stack[height++] = 0;
  while (height > 0 && advance.until() > 0) {
    const std::uint32_t index = stack[--height];
    const Node& node = nodes_[index];
    if (prism.apart(node.box, reach))
      continue;
    if (node.count == 0) { // the child nearer to the start first: early hits spare the rest of the sweep
      std::uint32_t a = index + 1, b = node.first;
      if (nodes_[a].box.squaredExteriorDistance(center) < nodes_[b].box.squaredExteriorDistance(center))
        std::swap(a, b);
      stack[height++] = a;
      stack[height++] = b;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle3& other = corners_[i];
      if (prism.apart(other, reach))
        continue;
      const double before = advance.until();
      advance.against(other, face_normals_[order_[i]]);
      if (advance.until() < before)
        prism = Prism({moving.start, moving.at(advance.until())});
    }
  }
  return advance.hit();
}

} // namespace sheet::solid
