// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/passing.h"
#include "libsheet/plan/running_down.h"
#include "libsheet/plan/slopes.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/scales.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;

// Until what enters there at `speed` has gone the way to the nearest outflow [s].
double time_to_leave(const Scene& scene, const Vector3& inlet, double speed) {
  double time = std::numeric_limits<double>::infinity();
  for (const scene::Outflow& outflow : scene.outflows)
    time = std::min(time, std::abs((outflow.point - inlet).dot(outflow.normal.normalized())) / speed);
  return time;
}

// What has flowed in at the end, and not yet left [m²].
double entered_area(const Scene& scene, const Frame& first, double until, double edge) {
  const auto inlets = masks(first, "inlet");
  double area = 0;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const scene::Inflow& inflow = scene.inflows[i];
    const double speed = scene::inlet_velocity(scene, inflow).speed(first.time);
    for (std::size_t v = 0; v < inlets.size(); ++v)
      if ((of_inlet(inlets[v], i) & at_inlet_border) != 0)
        area += edge * speed *
                std::min({until, inflow.until.value_or(until), time_to_leave(scene, positions(first)[v], speed)});
  }
  return area;
}

bool lies_on_itself(const Scene& scene) { return scene.contact && scene.contact->self && !scene.inflows.empty(); }

// Of a frame in a ring, for each vertex and its share of triangles and edges.
double bytes_of_a_vertex(const Scene& scene) {
  constexpr double alone = 140; // positions, velocities, triangles, volumes, directors, the step's start
  constexpr double touching = 40, at_inlets = 32, contacts = 80;
  return alone + (scene.solids.empty() ? 0 : touching) + (scene.inflows.empty() ? 0 : at_inlets) +
         (lies_on_itself(scene) ? contacts : 0);
}

// In the mean over the run, which ends at `until` [s].
double vertices_of_sheets_that_enter(const Scene& scene, double until) {
  double vertices = 0;
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (const auto& enters = scene.sheets[i].enters; enters && *enters < until)
      vertices += static_cast<double>(build_sheet(scene, i, Notes::silent).vertices) * (1 - *enters / until);
  return vertices;
}

// What a sheet that falls freely lands on does not drive it on.
bool only_falls(const Scene& scene, const std::vector<Landing>& all) {
  return scene.holds.empty() && scene.inflows.empty() && !all.empty() &&
         std::ranges::none_of(
             all, [&](const Landing& landing) { return scene.solids[landing.solid].surface_velocity.norm() > 0; });
}

// The greatest speed at which liquid flows in, if all of it does so as a layer on solids along which it flows [m/s].
std::optional<double> speed_along_solids(const Scene& scene, const Frame& first) {
  constexpr double near_enough = 0.75; // of the thickness: from the solid, of what lies on it
  if (scene.inflows.empty() || !scene::flows_on_solids(scene))
    return std::nullopt;
  const solid::Solids solids(scene);
  const auto lies = [&](const Vector3& x, double thickness) {
    for (std::size_t i = 0; i < solids.size(); ++i)
      if (scene.solids[i].contact == SolidContact::flow &&
          solids.at(i, x, first.time).distance < near_enough * thickness)
        return true;
    return false;
  };
  const auto inlets = masks(first, "inlet");
  double speed = 0;
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    for (std::size_t v = 0; v < inlets.size(); ++v)
      if ((of_inlet(inlets[v], i) & at_inlet_border) != 0 && !lies(positions(first)[v], scene.inflows[i].thickness))
        return std::nullopt;
    speed = std::max(speed, scene::inlet_velocity(scene, scene.inflows[i]).speed(first.time));
  }
  return speed;
}

// Steps besides those that end at output times.
double steps_of_motion(const Scene& scene, const Frame& first, double until, double edge, double tolerance) {
  constexpr double falls = 2.25, times_of_flow = 5;
  if (const auto down = runs_down(scene, first, first.time); down && scene.inflows.empty() && scene.holds.empty())
    return until * down->speed / (edge / 2); // energy/walls.h: longest_step_on_walls
  if (const auto along = speed_along_solids(scene, first); along && scene.holds.empty())
    return until * *along / (edge / 2); // a layer creeps, however it is driven
  const std::vector<Landing> all = landings(scene, first);
  const double gravity = scene.environment.gravity.value_or(Vector3::Zero()).norm();
  const double falling = falls * fall_time(scene, all);
  const bool falls_freely = only_falls(scene, all);
  double acceleration = falls_freely ? gravity : 0, flow = 0; // some times of the flow [s]
  for (const scene::Scales& scales : scene::scales_of_sheets(scene, measured_on_solids(scene, first)))
    if (!falls_freely && scales.length && *scales.length > 0) {
      acceleration = std::max(acceleration, scales.speed * scales.speed / *scales.length);
      flow = std::max(flow, times_of_flow * *scales.length / scales.speed);
    }
  const bool drawn = drawing_time(scene, first) > 0; // then what drives it faster is soon in balance with its holds
  double end = scene.inflows.empty() ? falls_freely ? falling : drawn ? flow : until : 0;
  for (const scene::Inflow& inflow : scene.inflows)
    end = std::max(end, inflow.until ? *inflow.until + falling : until);
  return acceleration > 0 ? std::min(end, until) / std::sqrt(tolerance * edge / acceleration) : 0;
}

// By how much a motion turns until then [rad].
double turned(const scene::Motion& motion, double from, double until) {
  constexpr int parts = 1000;
  double angle = 0;
  for (int k = 0; k < parts; ++k) {
    const double t = from + (k + 0.5) / parts * (until - from);
    const Vector3 middle = scene::velocity_at(motion, t, Vector3::Zero());
    double squares = 0; // of ω x e over three axes: 2 ω²
    for (int axis = 0; axis < 3; ++axis)
      squares += (scene::velocity_at(motion, t, Vector3::Unit(axis)) - middle).squaredNorm();
    angle += std::sqrt(squares / 2) * (until - from) / parts;
  }
  return angle;
}

// Of layers that flow or slip on what turns: a step's velocities are means over a part of it, of directions that turn,
// so they are wrong by (ω τ)² ω R, R the distance from the axis; and nothing may slide by more than half an edge.
double steps_of_turning(const Scene& scene, const Frame& first, double until, double edge) {
  const double across = *measured(first).length;
  std::vector<std::int32_t> under = touched_solids(first, scene.solids.size());
  for (const Landing& landing : landings(scene, first))
    under.push_back(static_cast<std::int32_t>(landing.solid));
  std::ranges::sort(under);
  under.erase(std::unique(under.begin(), under.end()), under.end());
  double steps = 0;
  for (const std::int32_t i : under)
    if (i != no_solid && scene.solids[static_cast<std::size_t>(i)].contact != SolidContact::stick)
      steps = std::max(steps, turned(scene.solids[static_cast<std::size_t>(i)].motion, first.time, first.time + until) /
                                  std::cbrt(edge / across));
  return steps;
}

// With so many digits, but for those before the point.
std::string roughly(double value, int digits) {
  const double unit = value > 0 ? std::pow(10, std::floor(std::log10(value)) + 1 - digits) : 1;
  return fmt::format("{:.10g}", std::round(value / unit) * unit);
}

} // namespace

Forecast forecast(const Scene& scene, const Frame& first, const ProposedRing& ring, double tolerance) {
  constexpr double of_a_frame = 2500;              // names of arrays, the scene, what made it [bytes]
  constexpr double on_one_thread = 2.5e-5;         // for a vertex, in a step [s]
  constexpr double with_a_law = 3, with_yield = 5; // more iterations a step
  const double edge = scene::mean_edge(first), start = static_cast<double>(first.vertices);
  const double area = std::pow(*measured(first).length, 2), until = std::max(0.0, ring.until - first.time);
  constexpr double in_folds = 3; // times as many vertices
  const double entered = entered_area(scene, first, until, edge) / area * start * (ring.folds ? in_folds : 1);
  Forecast run{};
  run.frames = 1 + std::ceil(until * ring.fps * (1 - 1e-9));
  run.vertices = start + entered / 2 + vertices_of_sheets_that_enter(scene, until);
  run.bytes = run.frames * (of_a_frame + run.vertices * bytes_of_a_vertex(scene));
  run.steps =
      run.frames - 1 +
      std::max(steps_of_motion(scene, first, until, edge, tolerance), steps_of_turning(scene, first, until, edge));
  double slower = 1;
  for (const Liquid& liquid : scene::liquids_of(scene))
    slower = std::max(slower, liquid.law.newtonian() ? 1 : liquid.law.yields() ? with_yield : with_a_law);
  run.seconds = run.steps * run.vertices * on_one_thread * slower;
  return run;
}

std::string forecast_text(const Scene& scene, const Frame& first, const ProposedRing& ring, double tolerance) {
  const Forecast run = forecast(scene, first, ring, tolerance);
  return fmt::format("  To expect: {:.0f} frames, about {} MB; about {} steps, {} s of computing on one thread. Most\n"
                     "  scenes come within three times of that; strands, thin films and what crumples take more.\n",
                     run.frames, roughly(run.bytes / 1e6, 2), roughly(std::round(run.steps), 2),
                     roughly(run.seconds, 1));
}

std::string forecast_lines(const Forecast& run) {
  return fmt::format("frames {:.0f}\nmegabytes {:.3g}\nsteps {:.0f}\nseconds {:.3g}\n", run.frames, run.bytes / 1e6,
                     run.steps, run.seconds);
}

} // namespace sheet
