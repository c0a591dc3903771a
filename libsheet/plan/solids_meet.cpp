// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/solids_meet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/brief.h"
#include "libsheet/sheet/sheet.h"
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

// Of two that start apart; nothing of those that start in each other, as parts of one thing do. depth_at: how deep they
// are in each other at a time [m].
template <class Depth>
std::optional<Meeting> meeting_of(const Depth& depth_at, double start, double until, double thickness) {
  if (depth_at(start) > resting * thickness)
    return std::nullopt;
  std::optional<Meeting> meeting;
  for (int k = 1; k <= times; ++k) {
    const double t = start + (until - start) * k / times, depth = depth_at(t);
    if (depth > (meeting ? meeting->deepest : deep * thickness))
      meeting = {meeting ? meeting->begins : t, depth};
  }
  return meeting;
}

bool moves(const scene::Motion& motion) { return !std::holds_alternative<scene::Fixed>(motion); }
bool is_moved(const scene::Solid& solid) { return moves(solid.motion); }

// What gives way to nothing: places at the start [m], how they move, and until when [s].
struct Prescribed {
  std::string name;
  std::optional<std::size_t> hold; // its number; of inlets none
  std::vector<Vector3> places;
  scene::Motion motion;
  double until;
};

// Of the vertices with a bit of an array of the frame, some hundred.
template <class Counts>
std::vector<Vector3> some_places(const formats::Frame& first, std::string_view array, const Counts& counts) {
  constexpr std::size_t most = 200;
  std::vector<Vector3> places;
  const auto bits = masks(first, array);
  for (std::size_t v = 0; v < bits.size(); ++v)
    if (counts(bits[v]))
      places.push_back(positions(first)[v]);
  const std::size_t every = places.size() / most + 1;
  std::vector<Vector3> some;
  for (std::size_t i = 0; i < places.size(); i += every)
    some.push_back(places[i]);
  return some;
}

std::vector<Prescribed> what_is_prescribed(const Scene& scene, const formats::Frame& first) {
  constexpr double forever = std::numeric_limits<double>::infinity();
  std::vector<Prescribed> all;
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (const scene::Hold& hold = scene.holds[i]; !hold.roll && hold.axes == all_axes)
      all.push_back({fmt::format("what [[hold]] number {} (from 0) holds", i), i,
                     some_places(first, "hold", [i](std::uint64_t bits) { return (bits >> i & 1) != 0; }), hold.motion,
                     hold.until.value_or(forever)});
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    all.push_back(
        {fmt::format("the inlet of inflow {}", i), std::nullopt,
         some_places(first, "inlet", [i](std::uint64_t bits) { return (of_inlet(bits, i) & at_inlet_border) != 0; }),
         scene::Fixed{}, scene.inflows[i].until.value_or(forever)});
  return all;
}

// Of something prescribed with a solid.
struct HeldMeeting {
  std::string name;
  std::optional<std::size_t> hold;
  std::size_t solid;
  Meeting when;
};
std::vector<HeldMeeting> meetings_with_what_is_held(const Scene& scene, const formats::Frame& first, double until) {
  std::vector<HeldMeeting> meetings;
  const scene::Measured sheet = measured(first);
  if (scene.solids.empty() || !sheet.thickness)
    return meetings;
  const solid::Solids solids(scene);
  for (const Prescribed& held : what_is_prescribed(scene, first))
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const double end = std::min(until, held.until);
      if ((!is_moved(scene.solids[i]) && !moves(held.motion)) || held.places.empty() || !(end > first.time))
        continue;
      const auto depth = [&](double t) {
        const Eigen::Isometry3d way = scene::motion_between(held.motion, first.time, t);
        double deepest = -std::numeric_limits<double>::infinity();
        for (const Vector3& x : held.places)
          deepest = std::max(deepest, -solids.at(i, way * x, t).distance);
        return deepest;
      };
      if (const auto meeting = meeting_of(depth, first.time, end, *sheet.thickness))
        meetings.push_back({held.name, held.hold, i, *meeting});
    }
  return meetings;
}

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
      const Pair pair(solids, points, a, b);
      const auto depth = [&](double t) { return pair.depth(t); };
      if (const auto meeting = meeting_of(depth, first.time, until, *sheet.thickness))
        warnings.push_back(fmt::format("{} and {} move into each other, from {:.2g} s on and by up to {} m: what lies "
                                       "between them has nowhere to go, and the run stalls there; their motions must "
                                       "leave it room",
                                       solids.name(a), solids.name(b), meeting->begins,
                                       scene::brief(meeting->deepest)));
    }
  return warnings;
}

std::vector<std::string> warnings_of_solids_that_meet_what_is_held(const Scene& scene, const formats::Frame& first,
                                                                   double until) {
  std::vector<std::string> warnings;
  for (const HeldMeeting& held : meetings_with_what_is_held(scene, first, until))
    warnings.push_back(fmt::format("{} and {} move into each other, from {:.2g} s on and by up to {} m: what is held "
                                   "there does not give way, and the run stalls or ends there; let them pass each "
                                   "other, or give it an `until`",
                                   held.name, solid::Solids(scene).name(held.solid), held.when.begins,
                                   scene::brief(held.when.deepest)));
  return warnings;
}

std::optional<HoldInSolid> hold_in_solid(const Scene& scene, const formats::Frame& first, double until) {
  std::optional<HoldInSolid> earliest;
  for (const HeldMeeting& held : meetings_with_what_is_held(scene, first, until))
    if (held.hold && !(earliest && earliest->time <= held.when.begins))
      earliest = {*held.hold, held.solid, held.when.begins};
  return earliest;
}

} // namespace sheet
