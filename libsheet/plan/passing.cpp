// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/passing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "libsheet/material/flow_curve.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/way_of_sheet.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using solid::Box3;

// Whether anything of a solid that turns comes to the sheet's way within a turn.
bool sweeps(const solid::Solids& solids, std::size_t number, double start, double turn, const Box3& way) {
  constexpr int poses = 32;
  const Box3& bounds = solids.shape(number).bounds();
  if (!bounds.sizes().allFinite())
    return true;
  Box3 swept;
  for (int i = 0; i < poses; ++i)
    swept.extend(bounds.transformed(solids.pose(number, start + turn * i / poses)));
  return swept.intersects(way);
}

// When a box that moves at this velocity from the time 0 on leaves another one; 0 if it does not come through.
double leaves(const Box3& moving, const Vector3& velocity, const Box3& other) {
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double before = other.min()[i] - moving.max()[i], behind = other.max()[i] - moving.min()[i];
    if (velocity[i] == 0) {
      if (before > 0 || behind < 0)
        return 0;
      continue;
    }
    const auto [first, last] = std::minmax({before / velocity[i], behind / velocity[i]});
    enters = std::max(enters, first);
    leaves = std::min(leaves, last);
  }
  return enters < leaves && leaves < std::numeric_limits<double>::infinity() ? leaves : 0;
}

// When a box that moves at this velocity from the time 0 on is wholly beyond a plane; 0 if it never is.
double is_taken_up(const Box3& moving, const Vector3& velocity, const scene::Outflow& outflow) {
  const double speed = velocity.dot(outflow.normal);
  const double way =
      outflow.normal.dot(outflow.point - moving.center()) + outflow.normal.cwiseAbs().dot(moving.sizes()) / 2;
  return speed > 0 ? std::max(0.0, way / speed) : 0;
}

// At which it moves on, and from when; nothing if it does not.
struct Moving {
  Vector3 velocity;
  double start;
};
std::optional<Moving> moving(const scene::Motion& motion, double first) {
  const auto* translating = std::get_if<scene::Translating>(&motion);
  const auto* turning = std::get_if<scene::Rotating>(&motion);
  const auto* timed = translating != nullptr ? &translating->velocity
                      : turning != nullptr   ? &turning->velocity
                                             : nullptr;
  if (timed == nullptr || timed->entries.empty())
    return std::nullopt;
  const double start = std::max(first, timed->entries.back().time);
  const Vector3 velocity = scene::value_at(*timed, start);
  return velocity.isZero(0) ? std::nullopt : std::optional(Moving{velocity, start});
}

// The time in which it turns once, from when it goes on turning for ever [s]; nothing if it does not.
struct Turning {
  double start, time;
};
std::optional<Turning> turning(const scene::Motion& motion, double first) {
  const auto* rotating = std::get_if<scene::Rotating>(&motion);
  if (rotating == nullptr || rotating->rate.entries.empty())
    return std::nullopt;
  const double start = std::max(first, rotating->rate.entries.back().time);
  const double rate = std::abs(scene::value_at(rotating->rate, start));
  return rate > 0 ? std::optional(Turning{start, 2 * std::numbers::pi / rate}) : std::nullopt;
}

bool rests(const scene::Solid& solid) { return std::holds_alternative<scene::Fixed>(solid.motion); }

Vector3 down_in(const Scene& scene) { return scene.environment.gravity.value_or(Vector3::Zero()).normalized(); }

// The way of the sheet until it has landed.
Box3 falling_way(const Scene& scene, const formats::Frame& first) {
  return way_of_sheet(first, longest_fall(landings(scene, first)) * down_in(scene));
}

// Whether any of what flows in lands on nothing.
bool flows_past(const formats::Frame& first, const solid::Solids& solids, const Vector3& down) {
  const auto inlets = masks(first, "inlet");
  for (std::size_t v = 0; v < inlets.size() && !down.isZero(0); ++v)
    if (inlets[v] != 0 &&
        !landing_below(solids, down, positions(first)[v], measured(first).length.value_or(0), first.time))
      return true;
  return false;
}

// In the world; that of a half-space is infinite.
Box3 box_of(const solid::Solids& solids, std::size_t number, double t) {
  const Box3& bounds = solids.shape(number).bounds();
  return bounds.sizes().allFinite() ? Box3(bounds.transformed(solids.pose(number, t))) : bounds;
}

// Whether all of a box is farther in a direction than all of another one.
bool is_beyond(const Box3& box, const Box3& other, const Vector3& direction) {
  const double apart = direction.dot(box.center() - other.center());
  return apart >= direction.cwiseAbs().dot(box.sizes() + other.sizes()) / 2;
}

// The way of the sheet, and of what flows in and lands on nothing: that falls past all solids.
Box3 whole_way(const Scene& scene, const formats::Frame& first, const solid::Solids& solids) {
  Box3 way = falling_way(scene, first);
  const Vector3 down = down_in(scene);
  if (way.isEmpty() || !flows_past(first, solids, down))
    return way;
  double fall = 0; // to the lowest of all solids [m]
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (const Box3 box = box_of(solids, i, first.time); box.sizes().allFinite())
      fall = std::max(fall, down.dot(box.center() - way.center()) + down.cwiseAbs().dot(box.sizes()) / 2);
  return way.extend(way.translated(fall * down));
}

// Whether a corner of a box, or its middle, is nearer to a solid than that [m].
bool is_near(const solid::Solids& solids, std::size_t number, const Box3& box, double t, double reach) {
  bool any = solids.at(number, box.center(), t).distance < reach;
  for (int i = 0; i < 8; ++i)
    any = any || solids.at(number, box.corner(static_cast<Box3::CornerType>(i)), t).distance < reach;
  return any;
}

// The longest way down a slope, along `ahead` (a unit vector), that a box goes until it is wholly in the bath, or
// beyond an outflow [m]; 0 if it comes to none.
double way_to_be_taken_up(const Scene& scene, const Box3& box, const Vector3& ahead) {
  double way = 0;
  for (const scene::Outflow& outflow : scene.outflows)
    way = std::max(way, is_taken_up(box, ahead, outflow));
  if (const auto& bath = scene.environment.bath; bath && scene.environment.gravity) {
    const Vector3 down = down_in(scene);
    way = std::max(way, is_taken_up(box, ahead, {.point = -bath->level * down, .normal = down}));
  }
  return way;
}

// The longest way down a slope that a box goes until it has come past the last of the solids that stay in its way, into
// the bath and beyond the last outflow [m]; 0 if it comes to none.
double way_down(const Scene& scene, const formats::Frame& first, const solid::Solids& solids, const Box3& box,
                std::size_t slope, const Vector3& pull) {
  const Vector3 ahead = pull.normalized();
  double farthest = way_to_be_taken_up(scene, box, ahead);
  for (std::size_t i = 0; i < solids.size(); ++i)
    if (const Box3 other = box_of(solids, i, first.time);
        i != slope && scene::stays_in_place(scene.solids[i].motion) && other.sizes().allFinite())
      farthest = std::max(farthest, leaves(box, ahead, other));
  return farthest;
}

// How far the front of a box is from the lower end of its slope, if that has one [m].
double way_to_end(const Box3& box, const Box3& slope, const Vector3& pull) {
  const Vector3 ahead = pull.normalized();
  const double way = ahead.dot(slope.center() - box.center()) + ahead.cwiseAbs().dot(slope.sizes() - box.sizes()) / 2;
  return std::isfinite(way) ? std::max(0.0, way) : 0;
}

// The mean place of what a hold holds [m].
Vector3 middle(const formats::Frame& frame, std::size_t hold) {
  const auto held = masks(frame, "hold");
  Vector3 sum = Vector3::Zero();
  double count = 0;
  for (std::size_t v = 0; v < held.size(); ++v)
    if ((held[v] >> hold & 1) != 0) {
      sum += positions(frame)[v];
      ++count;
    }
  return sum / count;
}

// What flows in as a layer that runs down a slope.
struct Running {
  std::size_t slope; // the number of the solid
  Vector3 pull;      // gravity along it [m/s²]
  double viscosity;  // kinematic, at the inlet's rate [m²/s]
  double flux, end;  // for each metre across its way [m²/s]; until when [s]

  // When it has come so far [s].
  [[nodiscard]] double time_to(double way) const {
    const double speed = std::cbrt(pull.norm() * flux * flux / (3 * viscosity)), all = flux * end;
    return std::max(way / speed, 4 * viscosity * way * way * way / (9 * all * all * pull.norm()));
  }
};

// Nothing of an inflow that lands on no slope along which it flows.
std::optional<Running> running(const Scene& scene, const formats::Frame& first, std::size_t number) {
  constexpr double least_slope = 0.1; // part of gravity along the solid
  const auto landing = landing_of_inflow(scene, first, number);
  const scene::Inflow& inflow = scene.inflows[number];
  const double speed = scene::inlet_velocity(scene, inflow).speed(first.time), rate = speed / inflow.thickness;
  if (!landing || scene.solids[landing->solid].contact != SolidContact::flow || !(speed > 0))
    return std::nullopt;
  const Vector3 gravity = *scene.environment.gravity, &normal = landing->there.normal;
  const Vector3 pull = gravity - gravity.dot(normal) * normal;
  if (pull.norm() < least_slope * gravity.norm())
    return std::nullopt;
  return Running{.slope = landing->solid,
                 .pull = pull,
                 .viscosity = viscosity_of(landing->liquid, {rate * rate}) / landing->liquid.density,
                 .flux = inflow.thickness * speed,
                 .end = inflow.until.value_or(std::numeric_limits<double>::infinity())};
}

// What lies on a slope from the start, or falls on it, and runs down it by its weight.
struct Sliding {
  std::size_t slope; // the number of the solid
  Vector3 pull;      // gravity along it [m/s²]
  Liquid liquid;
  double slip;    // length [m]
  double length;  // down the slope, at the start [m]
  double section; // volume for each metre across its way [m²]

  // When its front has come so far from where it is at the start [s]; 0 if it stands before. At x from its upper end
  // the front is 3/2 as thick as all is in the mean, and goes at the mean speed of such a layer: of a Newtonian liquid
  // dx/dt = 3 A² g_t/(4 ν x²) [Huppert 1982]; and no faster than what slides down freely from rest.
  [[nodiscard]] double time_to(double way) const {
    constexpr int parts = 100;
    double time = std::sqrt(2 * way / pull.norm());
    for (int i = 0; i < parts; ++i) {
      const double x = length + way * (i + 0.5) / parts, h = 1.5 * section / x;
      const double speed = scene::speed_of_layer(liquid, liquid.density * h * pull.norm(), h, slip);
      if (!(speed > 0))
        return 0;
      time += way / parts / speed;
    }
    return time;
  }
};

// From the first to the last vertex of a frame in a direction [m].
double extent(const formats::Frame& frame, const Vector3& direction) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Vector3& x : positions(frame)) {
    first = std::min(first, x.dot(direction));
    last = std::max(last, x.dot(direction));
  }
  return last - first;
}

// Nothing unless nine tenths of the sheet lie or land on one such solid at rest, along which it flows.
std::optional<Sliding> sliding(const Scene& scene, const formats::Frame& first) {
  constexpr double most = 0.9, least_slope = 0.1; // part of the sheet; of gravity along the solid
  const std::vector<Landing> all = landings(scene, first);
  if (all.empty() || !scene.inflows.empty() || scene.heat)
    return std::nullopt;
  const std::size_t slope = all.front().solid;
  const Vector3 gravity = *scene.environment.gravity;
  Vector3 pull = Vector3::Zero();
  double lands = 0;
  for (const Landing& landing : all)
    if (landing.solid == slope) {
      pull += gravity - gravity.dot(landing.there.normal) * landing.there.normal;
      ++lands;
    }
  pull /= lands;
  const Vector3 across = pull.cross(gravity);
  if (lands < most * static_cast<double>(probes_of(first).size()) || pull.norm() < least_slope * gravity.norm() ||
      scene.solids[slope].contact != SolidContact::flow || !rests(scene.solids[slope]) || across.isZero(0))
    return std::nullopt;
  const scene::Measured sheet = measured(first);
  return Sliding{.slope = slope,
                 .pull = pull,
                 .liquid = all.front().liquid,
                 .slip = scene.solids[slope].slip_length,
                 .length = extent(first, pull.normalized()),
                 .section =
                     *sheet.length * *sheet.length * sheet.thickness.value_or(0) / extent(first, across.normalized())};
}

struct Held {
  Moving motion;
  Vector3 middle; // at the start
};

} // namespace

double coming_through_time(const Scene& scene, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Box3 way = whole_way(scene, first, solids);
  double through = 0;
  for (std::size_t i = 0; i < solids.size() && !way.isEmpty(); ++i) {
    const Box3& bounds = solids.shape(i).bounds();
    const auto motion = moving(scene.solids[i].motion, first.time);
    if (!motion || !bounds.sizes().allFinite())
      continue;
    const auto& [velocity, start] = *motion;
    const double time = leaves(bounds.transformed(solids.pose(i, start)), velocity, way);
    if (time > 0)
      through = std::max(through, start + std::max(time, middle_size(way) / velocity.norm()));
  }
  return through;
}

double passing_time(const Scene& scene, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Box3 way = whole_way(scene, first, solids);
  double passed = coming_through_time(scene, first);
  for (std::size_t i = 0; i < solids.size() && !way.isEmpty(); ++i) {
    const scene::Motion& motion = scene.solids[i].motion;
    const auto turn = turning(motion, first.time);
    if (turn && !(moving(motion, first.time) && solids.shape(i).bounds().sizes().allFinite()) &&
        (!scene.inflows.empty() || sweeps(solids, i, turn->start, turn->time, way)))
      passed = std::max(passed, turn->start + turn->time);
  }
  return passed;
}

double carrying_time(const Scene& scene, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Box3 way = falling_way(scene, first);
  const Vector3 down = down_in(scene);
  const double thickness = measured(first).thickness.value_or(0);
  double carried = 0;
  for (std::size_t belt = 0; belt < solids.size() && !way.isEmpty(); ++belt) {
    if (scene.solids[belt].surface_velocity.isZero(0) || !rests(scene.solids[belt]) ||
        !is_near(solids, belt, way, first.time, thickness))
      continue;
    const Vector3 velocity = solids.at(belt, way.center(), first.time).velocity;
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const Box3 other = box_of(solids, i, first.time);
      if (i == belt || !scene::stays_in_place(scene.solids[i].motion) || !other.sizes().allFinite())
        continue;
      Box3 reached = way;
      if (is_beyond(other, box_of(solids, belt, first.time), velocity)) // there it falls from the belt's end
        reached.extend(way.translated(std::max(0.0, down.dot(other.center() - way.center())) * down));
      carried = std::max(carried, leaves(reached, velocity, other));
    }
    for (const scene::Outflow& outflow : scene.outflows)
      carried = std::max(carried, is_taken_up(way, velocity, outflow));
  }
  return carried > 0 ? first.time + carried : 0;
}

double running_time(const Scene& scene, const formats::Frame& first) {
  const solid::Solids solids(scene);
  const Box3 way = falling_way(scene, first);
  double passed = 0;
  for (std::size_t inflow = 0; inflow < scene.inflows.size() && !way.isEmpty(); ++inflow)
    if (const auto layer = running(scene, first, inflow)) {
      const double past = way_down(scene, first, solids, way, layer->slope, layer->pull),
                   to_end = way_to_end(way, box_of(solids, layer->slope, first.time), layer->pull);
      passed = std::max(passed, layer->time_to(std::max(past, to_end)));
    }
  if (const auto slides = sliding(scene, first))
    passed = std::max(passed, slides->time_to(way_down(scene, first, solids, way, slides->slope, slides->pull)));
  return passed > 0 ? first.time + passed : 0;
}

double drawing_time(const Scene& scene, const formats::Frame& first) {
  const Vector3 sizes = way_of_sheet(first, Vector3::Zero()).sizes();
  std::vector<Held> held; // those that are for ever
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (const scene::Hold& hold = scene.holds[i]; !hold.until && !hold.roll)
      held.push_back({moving(hold.motion, first.time).value_or(Moving{Vector3::Zero(), first.time}), middle(first, i)});
  double drawn = 0;
  for (const Held& one : held)
    for (const Held& other : held) {
      const Vector3 apart = one.motion.velocity - other.motion.velocity;
      if (apart.dot(one.middle - other.middle) > 0)
        drawn = std::max(drawn, std::max(one.motion.start, other.motion.start) +
                                    sizes.dot(apart.cwiseAbs()) / apart.squaredNorm());
    }
  return drawn;
}

double turning_time(const Scene& scene, const formats::Frame& first) {
  double turned = 0;
  for (const scene::Hold& hold : scene.holds)
    if (const auto turn = turning(hold.motion, first.time); turn && !hold.until && !hold.roll)
      turned = std::max(turned, turn->start + turn->time);
  return turned;
}

} // namespace sheet
