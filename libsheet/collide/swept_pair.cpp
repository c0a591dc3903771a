// SPDX-License-Identifier: GPL-3.0-or-later
// The features meet at time t iff the convex hull D(t) of the differences a_i(t) - b_j(t) of their points holds the
// origin. The differences move on straight lines, too, so over an interval D stays within the hull of the differences
// at its two ends, and a direction d with
//   d·(a_i - b_j) > gap |d|   for all i, j at both ends
// proves that the features are further apart than the gap all the time. Looking at differences takes the common motion
// out, whatever it is. Minkowski portal refinement [Snethen 2008, libccd's ccdMPRIntersect] of the hull, shifted and
// scaled to unit size, against a ball of the gap's radius finds that direction or says that there is none; its word is
// not taken for it: the inequality is evaluated. Without a proof the interval is halved, the earlier half first.
#include "libsheet/collide/swept_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ccd/ccd.h>

namespace sheet::collide {

namespace {

// Differences of the features' points: where they are at times 0 and 1.
struct Differences {
  int count = 0;
  std::array<Vector3, 4> start, end;
  double size = 0; // the largest
  bool moving = false;
};

Differences differences(const SweptPair& p) {
  Differences d;
  const std::size_t first = p.features == Features::vertex_triangle ? 1 : 2;
  for (std::size_t a = 0; a < first; ++a)
    for (std::size_t b = first; b < 4; ++b) {
      const auto i = static_cast<std::size_t>(d.count++);
      d.start[i] = p.start[a] - p.start[b];
      d.end[i] = p.end[a] - p.end[b];
      d.moving = d.moving || d.start[i] != d.end[i];
      d.size = std::max({d.size, d.start[i].lpNorm<Eigen::Infinity>(), d.end[i].lpNorm<Eigen::Infinity>()});
    }
  return d;
}

// Relative to the largest.
Differences scaled(Differences d) {
  if (d.size > 0)
    for (int i = 0; i < d.count; ++i) {
      d.start[i] /= d.size;
      d.end[i] /= d.size;
    }
  return d;
}

// The differences at both ends of an interval of time; `size` is the largest.
struct Hull {
  int count = 0;
  double size = 1;
  std::array<Vector3, 8> points;

  Hull(const Differences& d, double from, double to) {
    for (int i = 0; i < d.count; ++i) {
      points[count++] = (1 - from) * d.start[i] + from * d.end[i];
      points[count++] = (1 - to) * d.start[i] + to * d.end[i];
    }
  }
  // At both ends of all of the time, as they are.
  explicit Hull(const Differences& d) : size(d.size) {
    for (int i = 0; i < d.count; ++i) {
      points[count++] = d.start[i];
      points[count++] = d.end[i];
    }
  }
  // d·p > gap |d| for all points p.
  [[nodiscard]] bool beyond(const Vector3& direction, double gap) const {
    const double least = rounded_up(gap) * direction.norm();
    for (int i = 0; i < count; ++i)
      if (!(direction.dot(points[i]) > least)) // also where something is not a number
        return false;
    return true;
  }
  // The least d·p / |d| less the gap; of the directions that do not have all points on one side something below zero.
  [[nodiscard]] double room(const Vector3& direction, double gap) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count; ++i) {
      const double along = direction.dot(points[i]);
      if (!(along > 0))
        return -rounded_up(gap);
      least = std::min(least, along);
    }
    return least / direction.norm() - rounded_up(gap);
  }

private:
  // Differences, interpolation and products together round by less than 16 units in the last place of numbers below
  // twice the size; twice smallest_gap of it is a thousand times that.
  [[nodiscard]] double rounded_up(double gap) const { return gap + 2 * smallest_gap * size; }
};

// What libccd's callbacks see: the hull, and the last direction that it was asked about.
struct Queried {
  const Hull& hull;
  Vector3 direction = Vector3::Zero();
  int asked = 0;
};

// Portal refinement asks for a few supports, rarely 50. Where rounding keeps it from ending, an answer that puts the
// origin outside ends it, and the proof decides.
constexpr int most_questions = 200;

extern "C" {
void support_of_hull(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* furthest) {
  auto& queried = *static_cast<Queried*>(const_cast<void*>(object));
  const Vector3 d(direction->v[0], direction->v[1], direction->v[2]);
  queried.direction = d;
  Vector3 best = queried.hull.points[0];
  if (++queried.asked > most_questions) {
    best = -1e6 * d;
  } else {
    double most = d.dot(best);
    for (int i = 1; i < queried.hull.count; ++i)
      if (const double at = d.dot(queried.hull.points[i]); at > most) {
        most = at;
        best = queried.hull.points[i];
      }
  }
  ccdVec3Set(furthest, best.x(), best.y(), best.z());
}

void center_of_hull(const void* object, ccd_vec3_t* center) {
  const Hull& hull = static_cast<const Queried*>(object)->hull;
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < hull.count; ++i)
    sum += hull.points[i];
  sum /= hull.count;
  ccdVec3Set(center, sum.x(), sum.y(), sum.z());
}

void support_of_ball(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* furthest) {
  const double radius = *static_cast<const double*>(object), length = std::sqrt(ccdVec3Len2(direction));
  ccdVec3Copy(furthest, direction);
  ccdVec3Scale(furthest, length > 0 ? radius / length : 0);
}

void center_of_ball(const void*, ccd_vec3_t* center) { ccdVec3Set(center, 0, 0, 0); }
}

// Looks for a direction that proves the hull to be further than the gap from the origin; `direction` is tried first,
// and becomes the one found.
bool apart(const Hull& hull, double gap, Vector3& direction) {
  if (hull.beyond(direction, gap))
    return true;
  Queried queried{hull};
  const double radius = 1.001 * gap + 4 * smallest_gap;
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support_of_hull;
  ccd.support2 = support_of_ball;
  ccd.center1 = center_of_hull;
  ccd.center2 = center_of_ball;
  ccd.mpr_tolerance = 1e-9;
  if (ccdMPRIntersect(&queried, &radius, &ccd) != 0)
    return false;
  const Vector3 found = -queried.direction; // all of the hull lies on the far side
  if (!hull.beyond(found, gap))
    return false;
  direction = found;
  return true;
}

struct Search {
  const Differences& differences;
  double gap, time_tolerance;
  int left;
  Vector3 direction;
  double room = std::numeric_limits<double>::infinity(); // by how much farther than the gap, where it is proved

  // Depth first, earlier half first.
  std::optional<double> between(double from, double to) {
    if (--left < 0)
      return from;
    const Hull hull(differences, from, to);
    if (apart(hull, gap, direction)) {
      room = std::min(room, hull.room(direction, gap));
      return std::nullopt;
    }
    if (to - from <= time_tolerance)
      return from;
    const double middle = 0.5 * (from + to);
    if (const auto early = between(from, middle))
      return early;
    return between(middle, to);
  }
};

} // namespace

namespace {

// A first guess of a direction that points from one feature to the other.
Vector3 middle(const Hull& hull) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < hull.count; ++i)
    sum += hull.points[i];
  return sum;
}

// Another one: across the triangle, or both edges, at the start, as layers lie on each other.
Vector3 across(const Differences& d, const Vector3& towards) {
  const Vector3 normal = (d.start[1] - d.start[0]).cross(d.start[2] - d.start[0]);
  return normal.dot(towards) < 0 ? Vector3(-normal) : normal;
}

// The larger of what the two guesses prove.
double room(const Differences& d, double gap) {
  const Hull whole(d);
  const double wanted = std::max(gap, smallest_gap * d.size);
  const Vector3 direction = middle(whole);
  return std::max(whole.room(across(d, direction), wanted), whole.room(direction, wanted));
}

} // namespace

double sure_room(const SweptPair& pair, double gap) { return room(differences(pair), gap); }

bool surely_apart(const SweptPair& pair, double gap) {
  const Differences d = differences(pair);
  return !d.moving || room(d, gap) > 0;
}

ContactOrRoom contact_or_room(const SweptPair& pair, const SweptOptions& options) {
  const Differences d = scaled(differences(pair));
  if (!d.moving)
    return {};
  const Vector3 direction = options.towards.isZero(0) ? middle(Hull(d, 0, 1)) : options.towards;
  Search search{d, std::max(options.gap / d.size, smallest_gap), options.time_tolerance, options.budget, direction};
  const std::optional<double> contact = search.between(0, 1);
  return {contact, contact ? 0 : search.room * d.size};
}

} // namespace sheet::collide
