// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/over_edge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/way_along_solid.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/scene/motion.h"
#include "libsheet/sheet/sheet.h"

namespace sheet {

namespace {

bool has_edges(const scene::Solid& solid) {
  return solid.contact != SolidContact::stick && solid.surface_velocity.isZero(0) &&
         (std::holds_alternative<scene::SolidBox>(solid.shape) ||
          std::holds_alternative<scene::Cylinder>(solid.shape) ||
          std::holds_alternative<scene::SolidMesh>(solid.shape));
}

// Whether nothing takes up what runs down from there until the way leads under the solid.
bool is_in_the_open(WayAlongSolid way, const Vector3& gravity) {
  constexpr double underside = 0.5; // cosine between a face that looks down and gravity
  for (int i = 0; i < WayAlongSolid::most_steps && !way.taken_up(); ++i) {
    if (way.normal().dot(gravity) > underside * gravity.norm())
      return true;
    if (way.along(gravity).norm() < WayAlongSolid::least_slope * gravity.norm())
      return false;
    way.go(gravity);
  }
  return false;
}

// When what starts there from rest comes down to an edge in the open [s]: a layer h thick, or as thick as it carries
// that flux [m²/s].
std::optional<double> time_down(WayAlongSolid way, const Scene& scene, const scene::Solid& solid, const Liquid& liquid,
                                double h, double flux) {
  constexpr double below = 0.8; // cosine between gravity and a face below something round
  const Vector3 gravity = *scene.environment.gravity;
  double time = 0, speed = 0;
  for (int i = 0; i < WayAlongSolid::most_steps && !way.taken_up(); ++i) {
    const double pull = way.along(gravity).norm();
    if (pull < WayAlongSolid::least_slope * gravity.norm() || way.normal().dot(gravity) > below * gravity.norm())
      return std::nullopt;
    const double before = speed;
    if (solid.contact == SolidContact::slip) {
      speed = std::sqrt(before * before + 2 * pull * way.step());
    } else {
      const double thick = scene::thickness_of_layer(liquid, pull, flux, solid.slip_length, h);
      speed = scene::speed_of_layer(liquid, liquid.density * thick * pull, thick, solid.slip_length);
    }
    if (!(speed > 0))
      return std::nullopt;
    time += way.step() / (solid.contact == SolidContact::slip ? (before + speed) / 2 : speed);
    if (way.go(gravity))
      return is_in_the_open(way, gravity) ? std::optional(time) : std::nullopt;
  }
  return std::nullopt;
}

// Whether the way straight to that place passes an edge, beyond which no other solid is near.
bool passes_edge(WayAlongSolid way, const Vector3& target) {
  for (int i = 0; i < WayAlongSolid::most_steps && !way.taken_up(); ++i) {
    const Vector3 direction = target - way.x();
    if (way.along(direction).norm() < way.step())
      return false;
    if (way.go(direction))
      return !way.taken_up();
  }
  return false;
}

// Whether that face looks down, and the layer on it is too thick for surface tension to carry, 2 sqrt(gamma/(rho g)).
bool is_turned_over(const Vector3& normal, const Liquid& liquid, const Vector3& gravity, double h) {
  constexpr double looks_down = 0.2; // cosine
  return normal.dot(gravity) > looks_down * gravity.norm() &&
         h > 2 * std::sqrt(liquid.surface_tension / (liquid.density * gravity.norm()));
}

// When the solid stands as it will; nothing if it still turns at the end, or for ever.
std::optional<double> when_turned(const scene::Motion& motion, double start, double until) {
  if (!scene::turns(motion))
    return start;
  const std::vector<double> events = scene::events(motion);
  if (events.empty() || !(events.back() < until))
    return std::nullopt;
  const double end = std::max(start, events.back());
  const bool turns_on = !scene::motion_between(motion, end, until).linear().isIdentity(1e-6);
  return turns_on ? std::nullopt : std::optional(end);
}

struct OnSolid {
  const Scene& scene;
  const formats::Frame& first;
  const solid::Solids& solids;
  std::size_t number;
  std::vector<Landing> landings;       // on it
  double thickness, flux, from, until; // flux: of what flows in and lands on it, for each metre across its way [m²/s]

  [[nodiscard]] const scene::Solid& solid() const { return solids.scene(number); }
  [[nodiscard]] Vector3 carried(const Vector3& x, double t) const {
    return scene::motion_between(solid().motion, first.time, t) * x;
  }
};

std::optional<OverEdge> runs_over(const OnSolid& on) {
  const auto turned_at = when_turned(on.solid().motion, on.first.time, on.until);
  const bool held = std::ranges::any_of(on.scene.holds, [](const scene::Hold& hold) { return !hold.until; });
  if (!turned_at || (held && on.solid().contact == SolidContact::slip))
    return std::nullopt;
  constexpr std::size_t most_ways = 30;
  std::optional<OverEdge> earliest;
  const double gravity = on.scene.environment.gravity->norm();
  const std::size_t stride = on.landings.size() / most_ways + 1;
  for (std::size_t i = 0; i < on.landings.size(); i += stride) {
    const Landing& landing = on.landings[i];
    const double fall = std::max(0.0, landing.fall - on.thickness / 2);
    const double starts = std::max({*turned_at, on.from, on.first.time + std::sqrt(2 * fall / gravity)});
    const WayAlongSolid way(on.scene, on.solids, on.number, starts, on.thickness, on.carried(landing.place, starts));
    const auto takes = time_down(way, on.scene, on.solid(), landing.liquid, on.thickness, on.flux);
    if (!way.taken_up() && is_turned_over(way.normal(), landing.liquid, *on.scene.environment.gravity, on.thickness))
      return OverEdge{fmt::format("{} turns over with what lies on it", on.solids.name(on.number)), starts,
                      landing.liquid.density};
    const double time = takes ? starts + *takes : std::numeric_limits<double>::infinity();
    if (time < (earliest ? earliest->time : on.until))
      earliest = OverEdge{fmt::format("what lies on {} {} down over its edge, from about {:.2g} s on",
                                      on.solids.name(on.number),
                                      on.solid().contact == SolidContact::slip ? "slides" : "runs", time),
                          time, landing.liquid.density};
  }
  return earliest;
}

// When what starts there runs outwards over an edge off which it is flung [s]. On its way a film thins: h r² stays
// [Emslie, Bonner and Peck 1958, J. Appl. Phys. 29].
std::optional<double> time_outwards(const OnSolid& on, const Landing& landing, double starts) {
  const double gravity = on.scene.environment.gravity->norm();
  WayAlongSolid way(on.scene, on.solids, on.number, starts, on.thickness, on.carried(landing.place, starts));
  const double at_start = scene::outward_pull(on.solid().motion, on.until, way.x()).norm();
  double time = starts;
  for (int i = 0; i < WayAlongSolid::most_steps && !way.taken_up() && time < on.until; ++i) {
    const Vector3 pull = scene::outward_pull(on.solid().motion, on.until, way.x());
    const double h = on.thickness * std::pow(at_start / pull.norm(), 2);
    const double driven = landing.liquid.density * h * way.along(pull).norm();
    const double speed = scene::speed_of_layer(landing.liquid, driven, h, on.solid().slip_length);
    if (!(speed > 0))
      return std::nullopt;
    time += way.step() / speed;
    if (way.go(pull))
      return pull.norm() > gravity ? std::optional(time) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<OverEdge> flung_over(const OnSolid& on) {
  const auto* turning = std::get_if<scene::Rotating>(&on.solid().motion);
  if (turning == nullptr || turning->rate.entries.empty() || on.solid().contact != SolidContact::flow)
    return std::nullopt;
  const double turns_on = std::max(on.from, turning->rate.entries.back().time);
  std::optional<OverEdge> earliest;
  for (const Landing& landing : on.landings) {
    const double fall = std::max(0.0, landing.fall - on.thickness / 2);
    const double lands = on.first.time + std::sqrt(2 * fall / on.scene.environment.gravity->norm());
    const auto time = time_outwards(on, landing, std::max(turns_on, lands));
    if (time && *time < (earliest ? earliest->time : on.until))
      earliest = OverEdge{fmt::format("{} flings what lies on it over its edge, from about {:.2g} s on",
                                      on.solids.name(on.number), *time),
                          *time, landing.liquid.density};
  }
  return earliest;
}

// The middle of what a hold holds at the start.
std::optional<Vector3> middle_of_hold(const formats::Frame& first, std::size_t hold) {
  const auto masks = holds(first);
  const auto x = positions(first);
  Vector3 sum = Vector3::Zero();
  double count = 0;
  for (std::size_t v = 0; v < masks.size(); ++v)
    if ((masks[v] >> hold & 1) != 0) {
      sum += x[v];
      ++count;
    }
  return count > 0 ? std::optional<Vector3>(sum / count) : std::nullopt;
}

std::optional<OverEdge> drawn_over(const OnSolid& on, std::size_t number) {
  constexpr int poses = 20;
  constexpr double lies = 2.5; // thicknesses
  const scene::Hold& hold = on.scene.holds[number];
  const auto middle = middle_of_hold(on.first, number);
  if (hold.roll || !middle)
    return std::nullopt;
  const Landing* nearest = nullptr;
  for (const Landing& landing : on.landings)
    if (landing.fall < lies * on.thickness &&
        (nearest == nullptr || (landing.place - *middle).norm() < (nearest->place - *middle).norm()))
      nearest = &landing;
  if (nearest == nullptr)
    return std::nullopt;
  const double start = on.first.time, end = std::min(on.until, hold.until.value_or(on.until));
  for (int i = 1; i <= poses; ++i) {
    const double t = start + (end - start) * i / poses;
    const Vector3 place = on.carried(nearest->place, t),
                  target = scene::motion_between(hold.motion, start, t) * *middle;
    const bool away = (target - place).norm() > (*middle - nearest->place).norm() + on.thickness;
    if (away && on.solids.at(on.number, target, t).distance > WayAlongSolid::in_reach * on.thickness &&
        passes_edge(WayAlongSolid(on.scene, on.solids, on.number, t, on.thickness, place), target))
      return OverEdge{fmt::format("hold {} draws what lies on {} over its edge", number, on.solids.name(on.number)), t,
                      nearest->liquid.density};
  }
  return std::nullopt;
}

// Less what a bath bears of what floats on it [kg/m³].
double density_over_bath(const scene::Environment& environment, double density) {
  return environment.bath && density < environment.bath->density ? density * (1 - density / environment.bath->density)
                                                                 : density;
}

// What an inflow drives along an upright wall of the solid comes past its end, beyond which no other solid is near.
std::optional<OverEdge> driven_past(const OnSolid& on, std::size_t number) {
  constexpr double near = 0.75, upright = 0.3, off = 0.3; // thicknesses; cosines: to gravity, to the way
  const scene::Inflow& inflow = on.scene.inflows[number];
  const double start = on.first.time, end = std::min(on.until, inflow.until.value_or(on.until));
  if (!std::holds_alternative<scene::Fixed>(on.solid().motion))
    return std::nullopt;
  const auto x = positions(on.first);
  const scene::FrameLiquids liquids(on.scene, on.first);
  const std::vector<std::uint32_t> liquid_at = liquids.numbers_at_vertices(on.first);
  const scene::InletVelocity velocity = scene::inlet_velocity(on.scene, inflow);
  std::optional<OverEdge> earliest;
  for (const std::size_t v : probes_of(on.first)) {
    const solid::SolidPoint point = on.solids.at(on.number, x[v], start);
    if (std::abs(point.distance) > near * on.thickness ||
        std::abs(point.normal.dot(*on.scene.environment.gravity)) > upright * on.scene.environment.gravity->norm())
      continue;
    const Vector3 drive = velocity.at(start, x[v]);
    WayAlongSolid way(on.scene, on.solids, on.number, start, on.thickness, x[v]);
    double time = start;
    bool past = false;
    for (int i = 0;
         i < WayAlongSolid::most_steps && time < end && way.along(drive).norm() > off * drive.norm() && !past; ++i) {
      time += way.step() / drive.norm();
      past = way.go(drive);
    }
    if (past && !way.meets_another() && time < (earliest ? earliest->time : end))
      earliest = OverEdge{
          fmt::format("inflow {} drives what touches {} along it past its end, from about {:.2g} s on", number,
                      on.solids.name(on.number), time),
          time, density_over_bath(on.scene.environment, liquids.all()[liquid_at.empty() ? 0 : liquid_at[v]].density)};
  }
  return earliest;
}

} // namespace

std::optional<OverEdge> goes_over_edge(const Scene& scene, const formats::Frame& first, const std::vector<Landing>& all,
                                       double from, double until) {
  const solid::Solids solids(scene);
  const double thickness = *measured(first).thickness;
  std::optional<OverEdge> earliest;
  const auto consider = [&](const std::optional<OverEdge>& found) {
    if (found && (!earliest || found->time < earliest->time))
      earliest = found;
  };
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (!has_edges(scene.solids[i]))
      continue;
    OnSolid on{scene, first, solids, i, {}, thickness, flux_onto(scene, first, i, until), from, until};
    std::ranges::copy_if(all, std::back_inserter(on.landings), [&](const Landing& l) { return l.solid == i; });
    consider(runs_over(on));
    consider(flung_over(on));
    for (std::size_t k = 0; k < scene.holds.size(); ++k)
      consider(drawn_over(on, k));
    for (std::size_t k = 0; k < scene.inflows.size(); ++k)
      consider(driven_past(on, k));
  }
  return earliest;
}

} // namespace sheet
