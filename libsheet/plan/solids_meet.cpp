// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/solids_meet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/brief.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

constexpr int times = 200;
constexpr int across = 13;       // points along a side of a box around a solid: odd, so that poles are among them
constexpr double deep = 0.1;     // of the thickness
constexpr double resting = 0.01; // likewise: as deep two may start that rest on each other

// Points of a solid's surface, in its own frame: those next to a grid on the faces of its box. Of a half-space none.
std::vector<Vector3> surface_points(const solid::SolidDistance& shape) {
  const solid::Box3 box = shape.bounds();
  std::vector<Vector3> points;
  if (!box.sizes().allFinite())
    return points;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
          Vector3 part;
          part[axis] = side;
          part[(axis + 1) % 3] = i / (across - 1.0);
          part[(axis + 2) % 3] = j / (across - 1.0);
          const Vector3 x = box.min() + part.cwiseProduct(box.sizes());
          const solid::Near near = shape.nearest(x);
          points.emplace_back(x - near.distance * near.normal);
        }
  return points;
}

// What is known of two solids over time.
class Pair {
public:
  Pair(const solid::Solids& solids, const std::vector<std::vector<Vector3>>& points, std::size_t a, std::size_t b)
      : solids_(solids), points_(points), a_(a), b_(b) {}

  // How deep they are in each other at time t, as far as their points tell [m]; negative: how far apart, or less.
  [[nodiscard]] double depth(double t) const { return std::max(depth_of(a_, b_, t), depth_of(b_, a_, t)); }

private:
  // Of points of one in the other.
  [[nodiscard]] double depth_of(std::size_t one, std::size_t other, double t) const {
    const Eigen::Isometry3d way = solids_.pose(other, t).inverse() * solids_.pose(one, t);
    const solid::SolidDistance& shape = solids_.shape(other);
    double deepest = -std::numeric_limits<double>::infinity();
    for (const Vector3& x : points_[one])
      deepest = std::max(deepest, -shape.distance(way * x, 0));
    return deepest;
  }

  const solid::Solids& solids_;
  const std::vector<std::vector<Vector3>>& points_;
  std::size_t a_, b_;
};

struct Meeting {
  double begins, deepest; // [s], [m]
};

// Of two that start apart; nothing of those that start in each other, as parts of one thing do.
std::optional<Meeting> meeting_of(const Pair& pair, double start, double until, double thickness) {
  if (pair.depth(start) > resting * thickness)
    return std::nullopt;
  std::optional<Meeting> meeting;
  for (int k = 1; k <= times; ++k) {
    const double t = start + (until - start) * k / times, depth = pair.depth(t);
    if (depth > (meeting ? meeting->deepest : deep * thickness))
      meeting = {meeting ? meeting->begins : t, depth};
  }
  return meeting;
}

bool is_moved(const scene::Solid& solid) { return !std::holds_alternative<scene::Fixed>(solid.motion); }

} // namespace

std::vector<std::string> warnings_of_solids_that_meet(const Scene& scene, const formats::Frame& first, double until) {
  std::vector<std::string> warnings;
  const scene::Measured sheet = measured(first);
  if (scene.solids.size() < 2 || std::ranges::none_of(scene.solids, is_moved) || !sheet.thickness ||
      !(until > first.time))
    return warnings;
  const solid::Solids solids(scene);
  std::vector<std::vector<Vector3>> points;
  for (std::size_t i = 0; i < solids.size(); ++i)
    points.push_back(surface_points(solids.shape(i)));
  for (std::size_t a = 0; a < solids.size(); ++a)
    for (std::size_t b = a + 1; b < solids.size(); ++b) {
      if (!is_moved(scene.solids[a]) && !is_moved(scene.solids[b]))
        continue;
      if (const auto meeting = meeting_of(Pair(solids, points, a, b), first.time, until, *sheet.thickness))
        warnings.push_back(fmt::format("{} and {} move into each other, from {:.2g} s on and by up to {} m: what lies "
                                       "between them has nowhere to go, and the run stalls there; their motions must "
                                       "leave it room",
                                       solids.name(a), solids.name(b), meeting->begins,
                                       scene::brief(meeting->deepest)));
    }
  return warnings;
}

} // namespace sheet
