// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/running_down.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "libsheet/material/driven_rate.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/inlet_width.h"
#include "libsheet/plan/landing.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/layer_scales.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

constexpr std::size_t looked_at = 100; // vertices, about
constexpr double near_enough = 0.75;   // of the thickness: from the solid, of what lies on it
constexpr double above_a_plane = 2.5;  // likewise, of what comes down on all of it at once
constexpr double least_part = 0.5;     // of the sheet that lies
constexpr double least_slope = 0.1;    // part of gravity along the solid
constexpr double late = 2;             // times the run
constexpr double wider = 1.1;          // times as wide: what has spread
constexpr double much_later = 1000;    // times the run: what nobody waits for

std::string word_of_late(double until, std::string_view solid, std::string_view what, double time) {
  const double about = std::stod(fmt::format("{:.2g}", time));
  return fmt::format(
      "the run ends, at {} s, before what lands on {} has {}, which takes some {:.10g} s: --until {:.10g} "
      "shows that",
      until, solid, what, about, about);
}

// Nothing but its weight moves it, and what flows in.
bool is_free(const Scene& scene) { return !scene.heat && scene.holds.empty(); }

// What comes to a solid: a sheet as it is, or what an inflow brings, straight down.
struct Coming {
  double volume;   // infinite if it flows in for ever [m³]
  double flux = 0; // [m³/s]
};

// Nothing where several inflows come, or one aslant.
std::optional<Coming> coming(const Scene& scene, const formats::Frame& first, const Vector3& down) {
  constexpr double aslant = 0.3; // part of the speed
  const scene::Measured sheet = measured(first);
  if (scene.inflows.empty())
    return Coming{.volume = *sheet.length * *sheet.length * *sheet.thickness};
  const scene::Inflow& inflow = scene.inflows.front();
  const scene::InletVelocity velocity = scene::inlet_velocity(scene, inflow);
  const Vector3 entering = value_at(velocity.common, first.time);
  if (scene.inflows.size() > 1 || velocity.fans_out() || !(entering.dot(down) > 0) ||
      entering.cross(down).norm() > aslant * entering.norm())
    return std::nullopt;
  const double flux = width_of_inlet(first, 0) * inflow.thickness * entering.norm();
  return Coming{.volume = inflow.until ? flux * *inflow.until : std::numeric_limits<double>::infinity(), .flux = flux};
}

// In which a volume V has spread from a point to a radius r on level ground, of a liquid whose rate of strain goes as
// the stress^m [Halfar 1983; Bueler et al. 2005, J. Glaciol. 51]. With the height h in the middle,
//   V = 2 pi r² h m/(m+1) B(2 m/(m+1), (3 m+1)/(2 m+1)),   t = ((2 m+1)/(m+1))^m r/((5 m+3) u),   u = e h/(m+2),
// e the rate of strain at the stress rho g h²/r: 3 nu/(g V³) (r/0.894)⁸ of a Newtonian one [Huppert 1982].
double spreading_time(const Liquid& liquid, double volume, double r, double g) {
  const double m = liquid.law.kind == FlowLawKind::power ? 1 / liquid.law.flow_index : 1;
  const double filled = m / (m + 1) * std::beta(2 * m / (m + 1), (3 * m + 1) / (2 * m + 1));
  const double h = volume / (2 * std::numbers::pi * r * r * filled);
  const double speed = driven_rate(liquid, liquid.density * g * h * h / r) * h / (m + 2);
  return std::pow((2 * m + 1) / (m + 1), m) * r / ((5 * m + 3) * speed);
}

// Likewise of what comes: a flux Q takes (r/0.715)² (3 nu/(g Q³))^¼ [Huppert 1982]; what flows in and has ended takes
// no less than either [s].
double spreading_time(const Coming& what, double r, const Liquid& liquid, double g) {
  const double of_volume = spreading_time(liquid, what.volume, r, g), nu = liquid.viscosity / liquid.density;
  const double of_flux = std::pow(r / 0.715, 2) * std::pow(3 * nu / (g * std::pow(what.flux, 3)), 0.25);
  return what.flux > 0 ? std::max(of_volume, of_flux) : of_volume;
}

// The level way from a place to the nearest side of a box [m].
Vector3 way_to_edge(const solid::Box3& box, const Vector3& x, const Vector3& down) {
  Vector3 way = Vector3::Constant(std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3; ++i)
    for (const double side : {box.min()[i], box.max()[i]})
      if (std::abs(down[i]) < 0.5 && std::abs(side - x[i]) < way.norm())
        way = (side - x[i]) * Vector3::Unit(i);
  return way;
}

// Whether a solid stands in a way, as a wall of the one below does where that is hollow.
bool is_walled(const solid::Solids& solids, const Vector3& x, const Vector3& way, double t) {
  constexpr int points = 100;
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (int k = 0; k <= points; ++k)
      if (solids.at(i, x + k * way / points, t).distance < 0)
        return true;
  return false;
}

// To which a puddle draws together on it, or lies still [m].
double resting_thickness(const Liquid& liquid, const scene::Solid& solid, double g) {
  const double capillary_length = std::sqrt(liquid.surface_tension / (liquid.density * g));
  return 2 * capillary_length * std::sin(solid.contact_angle.value_or(std::numbers::pi) / 2);
}

// A solid at rest on which liquid flows.
struct LevelGround {
  std::size_t number;
  bool lies; // all of the sheet, on it from the start
};

// Of a free sheet, the only one, most of which lands there.
std::optional<LevelGround> level_ground(const Scene& scene, const formats::Frame& first,
                                        const std::vector<Landing>& all) {
  const scene::Measured sheet = measured(first);
  const auto rests = [&](const scene::Solid& solid) {
    return std::holds_alternative<scene::Fixed>(solid.motion) &&
           (scene.outflows.empty() || solid.surface_velocity.isZero());
  };
  if (all.empty() || !is_free(scene) || !scene.inflows.empty() || scene.sheets.size() > 1 || !sheet.length ||
      !sheet.thickness || !std::ranges::all_of(scene.solids, rests))
    return std::nullopt;
  const Vector3 down = scene.environment.gravity->normalized();
  std::optional<std::size_t> ground;
  double lands = 0;
  for (const Landing& landing : all) {
    const scene::Solid& below = scene.solids[landing.solid];
    if (below.contact == SolidContact::flow && std::holds_alternative<scene::HalfSpace>(below.shape) &&
        landing.there.normal.cross(down).norm() < least_slope) {
      ground = landing.solid;
      ++lands;
    }
  }
  if (!ground || lands < least_part * static_cast<double>(all.size()))
    return std::nullopt;
  return LevelGround{*ground,
                     longest_fall(all) < near_enough * *sheet.thickness && lands == static_cast<double>(all.size())};
}

} // namespace

std::optional<RunningDown> runs_down(const Scene& scene, const formats::Frame& first, double t) {
  const Vector3 gravity = scene.environment.gravity.value_or(Vector3::Zero());
  const scene::Measured sheet = measured(first);
  if (!scene::flows_on_solids(scene) || !sheet.length || !sheet.thickness || !(*sheet.length > 0))
    return std::nullopt;
  const solid::Solids solids(scene);
  const auto x = positions(first);
  const std::size_t stride = std::max<std::size_t>(1, x.size() / looked_at);
  const scene::FrameLiquids liquids(scene, first);
  const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(first);
  std::vector<bool> lying(liquids.all().size(), false);
  double lies = 0, along = 0, slip = 0, all = 0, flux = 0;
  for (std::size_t v = 0; v < x.size(); v += stride, ++all)
    for (std::size_t i = 0; i < solids.size(); ++i) {
      const solid::SolidPoint point = solids.at(i, x[v], first.time);
      const bool comes_down = std::holds_alternative<scene::HalfSpace>(scene.solids[i].shape) &&
                              -point.normal.dot(gravity) > least_slope * gravity.norm();
      const double reach = comes_down ? above_a_plane : near_enough;
      if (scene.solids[i].contact != SolidContact::flow || std::abs(point.distance) > reach * *sheet.thickness)
        continue;
      const Vector3 normal =
          solids.pose(i, t).linear() * (solids.pose(i, first.time).linear().transpose() * point.normal);
      const Vector3 place = scene::motion_between(scene.solids[i].motion, first.time, t) * x[v];
      const Vector3 pull = gravity + scene::outward_pull(scene.solids[i].motion, t, place);
      along += (pull - pull.dot(normal) * normal).norm();
      slip += scene.solids[i].slip_length;
      if (lies++ == 0)
        flux = flux_onto(scene, first, i, std::numeric_limits<double>::infinity());
      lying[numbers.empty() ? 0 : numbers[v]] = true;
      break;
    }
  if (lies < least_part * all || along < least_slope * gravity.norm() * lies)
    return std::nullopt;
  double speed = 0;
  for (std::size_t i = 0; i < lying.size(); ++i)
    if (const Liquid& liquid = liquids.all()[i]; lying[i]) {
      const double h = scene::thickness_of_layer(liquid, along / lies, flux, slip / lies, *sheet.thickness);
      speed = std::max(speed, scene::speed_of_layer(liquid, liquid.density * h * along / lies, h, slip / lies));
    }
  if (!(speed > 0) || !std::isfinite(speed))
    return std::nullopt;
  return RunningDown{speed, *sheet.length / speed};
}

std::string late_running_warning(const Scene& scene, const formats::Frame& first, double until) {
  const scene::Measured sheet = measured(first);
  const std::vector<Landing> all = landings(scene, first);
  if (all.empty() || !is_free(scene) || !scene.inflows.empty() || !sheet.length || !sheet.thickness)
    return "";
  const Vector3 gravity = *scene.environment.gravity;
  std::size_t lands = 0, solid = 0;
  double along = 0, slip = 0;
  for (const Landing& landing : all) {
    const scene::Solid& below = scene.solids[landing.solid];
    if (below.contact != SolidContact::flow || scene::turns(below.motion))
      continue;
    const Vector3& normal = landing.there.normal;
    along += (gravity - gravity.dot(normal) * normal).norm();
    slip += below.slip_length;
    solid = lands++ == 0 ? landing.solid : std::min(solid, landing.solid);
  }
  const double n = static_cast<double>(lands), h = *sheet.thickness;
  if (n < least_part * static_cast<double>(all.size()) || along < least_slope * gravity.norm() * n)
    return "";
  const Liquid& liquid = all.front().liquid;
  const double speed = scene::speed_of_layer(liquid, liquid.density * h * along / n, h, slip / n);
  const double time = fall_time(scene, all) + *sheet.length / 2 / speed;
  if (!(time > late * until && time < much_later * until))
    return "";
  return word_of_late(until, solid::Solids(scene).name(solid), "run down", time);
}

std::optional<Spreading> spreads(const Scene& scene, const formats::Frame& first) {
  const std::vector<Landing> all = landings(scene, first);
  const auto ground = level_ground(scene, first, all);
  if (!ground)
    return std::nullopt;
  const Liquid& liquid = all.front().liquid;
  const scene::Measured sheet = measured(first);
  const double g = scene.environment.gravity->norm(), h = *sheet.thickness, L = *sheet.length;
  if (!(liquid.law.newtonian() || liquid.law.kind == FlowLawKind::power) ||
      h < resting_thickness(liquid, scene.solids[ground->number], g))
    return std::nullopt;
  const double radius = L / std::sqrt(std::numbers::pi);
  const auto from_point = [&](double r) { return spreading_time(liquid, L * L * h, r, g); };
  return Spreading{.ground = ground->number,
                   .lies = ground->lies,
                   .time = fall_time(scene, all) + from_point(wider * radius) - from_point(radius)};
}

double levelling_time(const Scene& scene, const formats::Frame& first) {
  constexpr double seen = 0.01; // least wave, part of the thickness
  const std::vector<Landing> all = landings(scene, first);
  const auto ground = level_ground(scene, first, all);
  if (!ground || !ground->lies || !all.front().liquid.law.newtonian())
    return 0;
  const Liquid& liquid = all.front().liquid;
  const double h = *measured(first).thickness, b = scene.solids[ground->number].slip_length;
  const double weight = liquid.density * scene.environment.gravity->norm();
  const double tension = scene.model.faces ? liquid.surface_tension : 0;
  double time = 0;
  for (const scene::Perturbation& wave : scene.sheets.front().perturbations)
    if (const auto* form = std::get_if<scene::Wave>(&wave.form);
        form != nullptr && wave.of_thickness && std::abs(wave.amplitude) >= seen * h) {
      const double k = 2 * std::numbers::pi / form->wavelength, resistance = 3 / (h + 3 * b) + 4 * k * k * h;
      time = std::max(time, liquid.viscosity * resistance / (k * k * (weight + tension * k * k) * h * h));
    }
  return time;
}

std::string late_spreading_warning(const Scene& scene, const formats::Frame& first, double until) {
  const auto spreading = spreads(scene, first);
  if (!spreading || !(spreading->time > late * until && spreading->time < much_later * until))
    return "";
  return word_of_late(until, solid::Solids(scene).name(spreading->ground), "spread by a tenth", spreading->time);
}

std::string late_overrun_warning(const Scene& scene, const formats::Frame& first, double until) {
  constexpr double latest = 30, most = 0.9; // times the run; part of the sheet that lands on the top
  const scene::Measured sheet = measured(first);
  const std::vector<Landing> all = landings(scene, first);
  if (all.empty() || !is_free(scene) || !sheet.length || !sheet.thickness)
    return "";
  const std::size_t number = all.front().solid;
  const scene::Solid& below = scene.solids[number];
  const Liquid& liquid = all.front().liquid;
  const Vector3 gravity = *scene.environment.gravity, down = gravity.normalized();
  Vector3 middle = Vector3::Zero();
  double lands = 0;
  for (const Landing& landing : all)
    if (landing.solid == number && landing.there.normal.cross(down).norm() < least_slope) {
      middle += landing.place;
      ++lands;
    }
  const solid::Solids solids(scene);
  const solid::Box3 box = solids.shape(number).bounds().transformed(solids.pose(number, first.time));
  if (below.contact != SolidContact::flow || !std::holds_alternative<scene::Fixed>(below.motion) ||
      !box.sizes().allFinite() || !liquid.law.newtonian() ||
      lands < most * static_cast<double>(probes_of(first).size()))
    return "";
  const double g = gravity.norm(), h = *sheet.thickness, nu = liquid.viscosity / liquid.density;
  const auto what = coming(scene, first, down);
  const Vector3 way = way_to_edge(box, middle / lands, down);
  const double edge = way.norm();
  const Vector3 above = middle / lands - h * down, over = (1 + h / edge) * way;
  const auto beyond = landing_below(solids, down, above + over, *sheet.length, first.time);
  const double seen = scene.inflows.empty() ? *sheet.length / 2 : edge; // of the side
  const double side = std::min(beyond ? beyond->fall : edge, seen);
  if (!what || side < 2 * h || is_walled(solids, above, over, first.time) ||
      !(what->volume > std::numbers::pi * edge * edge * resting_thickness(liquid, below, g)))
    return "";
  const double around = what->flux / (2 * std::numbers::pi * edge);
  const double speed = around > 0 ? std::cbrt(g * around * around / (3 * nu))
                                  : scene::speed_of_layer(liquid, liquid.density * g * h / 2, h / 2, below.slip_length);
  const double time = fall_time(scene, all) + spreading_time(*what, edge, liquid, g) + side / speed;
  if (!(time > late * until && time < latest * until))
    return "";
  return word_of_late(until, solids.name(number), "come over its edge and run down it", time);
}

} // namespace sheet
