// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/proposed_ring.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "libsheet/geometry/area.h"
#include "libsheet/plan/blow_up.h"
#include "libsheet/plan/first_frame.h"
#include "libsheet/plan/forecast.h"
#include "libsheet/plan/hanging.h"
#include "libsheet/plan/holds_meet.h"
#include "libsheet/plan/landing.h"
#include "libsheet/plan/passing.h"
#include "libsheet/plan/piling.h"
#include "libsheet/plan/running_down.h"
#include "libsheet/plan/slopes.h"
#include "libsheet/plan/solids_meet.h"
#include "libsheet/plan/tiers.h"
#include "libsheet/scene/explain_heat.h"
#include "libsheet/scene/inlet_velocity.h"
#include "libsheet/scene/ring.h"
#include "libsheet/scene/scales.h"
#include "libsheet/scene/sheet_edges.h"
#include "libsheet/shape/build.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

using formats::Frame;

// What an inflow has become at the end of its fall [m].
double thickness_after_fall(const Scene& scene, const Frame& first, std::size_t number) {
  const scene::Inflow& inflow = scene.inflows[number];
  const double v0 = scene::inlet_velocity(scene, inflow).speed(first.time);
  const auto landing = landing_of_inflow(scene, first, number);
  return landing && v0 > 0 ? inflow.thickness * v0 / speed_after_fall(scene, v0, *landing) : inflow.thickness;
}

// The edges that sheet-remesh wants if it is not told [m].
double wanted_edge(const Scene& scene, const Frame& first) {
  return scene::shortest_stated_edge(scene).value_or(scene::shortest_own_edge(first));
}

// To three digits.
double in_short(double value) { return std::stod(fmt::format("{:.3g}", value)); }

// Half as long as the scene's, where these are too long for the folds of a layer as thick as what lands, and exactly
// half of what the ring says of these: sheet-remesh has no room where it is a digit more. None for drafts.
std::optional<EdgesInFolds> edges_in_folds(const Scene& scene, const Frame& first, Quality quality) {
  constexpr double fine_enough = 4; // thicknesses: folds have such edges when they lie on each other
  const double thickness = landing_thickness(scene, first), longest = in_short(wanted_edge(scene, first));
  if (quality == Quality::draft || longest < fine_enough * thickness || !scene.contact || !scene.contact->self ||
      !what_piles_up(scene, first, landings(scene, first)))
    return std::nullopt;
  return EdgesInFolds{.nearness = thickness / 2, .shortest = longest / 2, .longest = longest};
}

// The ring of the scene (scene/ring.h) at that quality.
std::string pipeline_at(const Scene& scene, Quality quality, const std::optional<EdgesInFolds>& edges) {
  std::string pipeline;
  for (const scene::RingStage& stage : scene::ring_of(scene)) {
    pipeline += (pipeline.empty() ? "" : " | ") + stage.program;
    if (edges && stage.program.starts_with("sheet-remesh"))
      pipeline += fmt::format(" --adaptive {:.1g} --min-edge {:.4g} --max-edge {:.3g}", edges->nearness,
                              edges->shortest, edges->longest);
    if (quality != Quality::normal && stage.program == "sheet-step")
      pipeline += fmt::format(" --tolerance {:g}", tolerance_at(quality));
  }
  return pipeline;
}

constexpr double round_off = 1e-9; // within which a number already is such a one

// A number that one likes to type: its first two digits.
double rounded(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::stod(fmt::format("{:.2g}", std::ceil(value / unit * (1 - round_off)) * unit));
}

// The same, not above the value.
double rounded_down(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::stod(fmt::format("{:.2g}", std::floor(value / unit * (1 + round_off)) * unit));
}

constexpr double before_blow_up = 0.9; // of the time to it

// Of what is warmed until it flows, counted from when it is warm; nothing of what is blown into a mould.
std::optional<double> blow_up_time_with_heat(const Scene& scene, const Frame& first) {
  const auto as_it_starts = blow_up_time(scene::as_it_starts(scene));
  if (as_it_starts && is_blown_into_mould(scene, first))
    return std::nullopt;
  const auto warming = scene::warming_of(scene, measured(first).thickness.value_or(0));
  const auto warm = warming ? blow_up_time(warming->warm) : std::nullopt;
  return as_it_starts && warm ? std::min(*as_it_starts, warming->time + *warm) : as_it_starts;
}

std::string word_of_blow_up(const Scene& scene, const Frame& first) {
  const auto end = blow_up_time_with_heat(scene, first);
  return end ? fmt::format(
                   "  The pressure blows the sheet up, to any size, within about {:.2g} s: end before, at {:.2g} s or "
                   "so.\n",
                   *end, before_blow_up * *end)
             : "";
}

constexpr double before_holds_meet = 0.9; // each other, or a solid: of the time to that

std::string word_of_holds_that_meet(const Scene& scene, const Frame& first, double until) {
  const auto meet = holds_meet(scene, first, until);
  return meet
             ? fmt::format("  [[hold]]s {} and {} (from 0) come together at about {:.2g} s, with no room between them: "
                           "end before, at {:.2g} s\n  or so.\n",
                           meet->one, meet->other, meet->time, before_holds_meet * meet->time)
             : "";
}

std::string word_of_hold_in_solid(const Scene& scene, const Frame& first, double until) {
  const auto meet = hold_in_solid(scene, first, until);
  return meet ? fmt::format("  [[hold]] {} (from 0) and {} move into each other at about {:.2g} s, where the run ends: "
                            "end before, at {:.2g} s or so.\n",
                            meet->hold, solid::Solids(scene).name(meet->solid), meet->time,
                            before_holds_meet * meet->time)
              : "";
}

// Of what creeps so long that its fall, from then on, is short.
std::string word_of_runaway(const Scene& scene, const Frame& first) {
  const auto end = runaway_time(scene, first);
  const double fall = std::sqrt(*measured(first).length / scene.environment.gravity.value_or(Vector3::Zero()).norm());
  return end && *end > fall
             ? fmt::format(
                   "  Its weight draws the sheet out, to any length, within about {:.2g} s; from then on it falls, in "
                   "steps of the fall.\n  [tear] below parts it, a solid below catches it.\n",
                   *end)
             : "";
}

// The nearest of 1, 2, 5, 10, ... that is not below.
double round_number(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)));
  return unit * (value > 5 * unit ? 10 : value > 2 * unit ? 5 : value > unit ? 2 : 1);
}

constexpr double longest_passing = 10; // of solids and belts that creep, in times of everything else

// Some times of the flow; of what its weight draws out some times of the fall after that.
double flow_time(const Scene& scene, const Frame& first) {
  constexpr double times = 5;
  const auto runaway = runaway_time(scene, first);
  double time = 0;
  for (const scene::Scales& scales : scene::scales_of_sheets(scene, measured_sheets(scene, first)))
    if (scales.length && scales.speed > 0) {
      const double of_flow = times * *scales.length / scales.speed, fall = std::sqrt(*scales.length / scales.gravity);
      time =
          std::max(time, runaway ? std::min(of_flow, rounded_down(before_blow_up * *runaway + times * fall)) : of_flow);
    }
  return time;
}

// Until what lies on a slope has run down it, after `at_rest` [s]; 0 where nothing does.
double time_down(const Scene& scene, const Frame& first, double at_rest) {
  const auto down = runs_down(scene, first, at_rest);
  return down ? at_rest + down->time : 0;
}

// Until what lies on level ground has spread by more than a tenth; 0 where nothing does.
double time_spread(const Scene& scene, const Frame& first) {
  constexpr double times = 2;
  const auto spreading = spreads(scene, first);
  return spreading && spreading->lies ? times * spreading->time : 0;
}

// Until the sheet, the only one, that lies on solids at rest has gone by its length, where nothing but its forces moves
// it and spreads() knows no better; 0 where it does not, or where that takes many times of everything else, `until`
// [s].
double time_along(const Scene& scene, const Frame& first, double until) {
  constexpr double much_later = 1000;
  const auto rests = [](const scene::Solid& solid) {
    return std::holds_alternative<scene::Fixed>(solid.motion) && solid.surface_velocity.isZero(0);
  };
  if (scene.sheets.size() > 1 || !std::ranges::all_of(scene.solids, rests) || !scene.holds.empty() ||
      !scene.inflows.empty() || spreads(scene, first))
    return 0;
  const scene::Scales scales = scene::scales_of_sheets(scene, measured_on_solids(scene, first)).front();
  const double time = scales.lies && scales.length && scales.speed > 0 ? *scales.length / scales.speed : 0;
  return time < much_later * until ? time : 0;
}

// Until its waves of thickness have levelled there; 0 where that takes many times of everything else, `until` [s].
double time_level(const Scene& scene, const Frame& first, double until) {
  constexpr double times = 2, much_later = 1000;
  const double time = times * levelling_time(scene, first);
  return time < much_later * until ? time : 0;
}

// That of the scene as it starts; of what is warmed until it flows, counted from when it is warm.
double with_heat(const Scene& scene, const Frame& first, const std::function<double(const Scene&)>& time_of) {
  const double as_it_starts = time_of(scene::as_it_starts(scene));
  const auto warming = scene::warming_of(scene, measured(first).thickness.value_or(0));
  return warming ? std::min(as_it_starts, warming->time + time_of(warming->warm)) : as_it_starts;
}

// That end, or when what flows until then has set before.
double until_set(const Scene& scene, const Frame& first, double until) {
  constexpr double longer = 100; // so long what has set goes on creeping
  const auto set = scene::setting_time(scene, measured(first).thickness.value_or(0));
  return set && until < longer * *set ? std::min(until, *set + 4 * fall_time(scene, landings(scene, first))) : until;
}

// The longest of the sheets' lengths [m].
double length_of(const Scene& scene, const Frame& first) {
  double length = 0;
  for (const scene::Scales& scales : scene::scales_of_sheets(scene, measured_sheets(scene, first)))
    length = std::max(length, scales.length.value_or(0));
  return length;
}

// The times of rows of all that moves and changes: holds, solids, heat, wind, what flows in [s].
std::vector<double> events_of(const Scene& scene) {
  std::vector<double> events = scene::heat_events(scene);
  for (const scene::Hold& hold : scene.holds)
    std::ranges::copy(scene::events(hold.motion), std::back_inserter(events));
  for (const scene::Solid& solid : scene.solids)
    std::ranges::copy(scene::events(solid.motion), std::back_inserter(events));
  if (scene.environment.air)
    for (const auto& entry : scene.environment.air->wind.entries)
      events.push_back(entry.time);
  for (const scene::Inflow& inflow : scene.inflows)
    std::ranges::copy(scene::inlet_velocity(scene, inflow).times(), std::back_inserter(events));
  return events;
}

// Until what flows in lands, or falls beyond an outflow [s]; 0 if it does neither. Viscosity holds back what hangs from
// the inlet: of a length L that flows in at u and is drawn out by its weight, dL/dt = u + k L², k = ρ g/(8 μ), as if it
// stayed as thick: so long it takes at the most, as it gets thinner where its weight is. Nor is it faster than it falls
// freely.
double landing_time(const Scene& scene, const Frame& first, std::size_t number) {
  const auto landing = landing_of_inflow(scene, first, number);
  const double fall = std::max(landing ? landing->fall : 0, fall_to_outflow(scene, first, number));
  const double u = scene::inlet_velocity(scene, scene.inflows[number]).speed(first.time);
  const double gravity = scene.environment.gravity.value_or(Vector3::Zero()).norm();
  if (!(fall > 0) || !(u > 0))
    return 0;
  const Liquid& liquid = scene::material_of(scene, sheet_named(scene, scene.inflows[number].sheet));
  const double freely = (std::sqrt(u * u + 2 * gravity * fall) - u) / gravity;
  const double k = liquid.viscosity > 0 ? liquid.density * gravity / (8 * liquid.viscosity) : 0;
  return k > 0 ? std::max(freely, std::atan(fall * std::sqrt(k / u)) / std::sqrt(k * u)) : freely;
}

// When belts have carried the first sheet and all that enter later past what is in their ways [s].
double all_carried_time(const Scene& scene, const Frame& first) {
  double time = carrying_time(scene, first);
  for (std::size_t i = 0; i < scene.sheets.size(); ++i)
    if (const auto& enters = scene.sheets[i].enters) {
      Frame later = build_sheet(scene, i, Notes::silent);
      later.time = *enters;
      time = std::max(time, carrying_time(scene, later));
    }
  return time;
}

// Some times of the flow, until that sets, of the fall and of what comes in, which overruns the tiers that it lands on;
// until whatever ends by the clock has ended, whatever moves on for ever has come through or round, belts and slopes
// have carried it past all, and what lies on solids has gone by its length, or spread and levelled.
double until_of(const Scene& scene, const Frame& first) {
  double at_rest = first.time; // all solids
  for (const scene::Solid& solid : scene.solids)
    for (const double time : scene::events(solid.motion))
      at_rest = std::max(at_rest, time);
  double until = with_heat(scene, first, [&](const Scene& of) { return flow_time(of, first); });
  if (until == 0)
    until = 1;
  until += 4 * fall_time(scene, landings(scene, first));
  until = std::max(until, with_heat(scene, first, [&](const Scene& of) { return time_down(of, first, at_rest); }));
  until = std::max(until, time_spread(scene, first));
  until = std::max(until, with_heat(scene, first, [&](const Scene& of) { return time_along(of, first, until); }));
  until = std::max(until, time_level(scene, first, until));
  until = until_set(scene, first, until);
  const auto ends = [&](double time) { until = std::max(until, 1.5 * time); };
  for (const scene::Hold& hold : scene.holds)
    ends(hold.until.value_or(0));
  for (const double time : events_of(scene))
    until = std::max(until, 1.1 * time);
  for (std::size_t i = 0; i < scene.inflows.size(); ++i) {
    const scene::Inflow& inflow = scene.inflows[i];
    ends(inflow.until.value_or(0));
    ends(landing_time(scene, first, i));
    if (const double speed = scene::inlet_velocity(scene, inflow).speed(first.time); speed > 0 && !inflow.until)
      until = std::max({until, 5 * length_of(scene, first) / speed, time_over_tiers(scene, first, i)});
  }
  for (const scene::SheetTable& sheet : scene.sheets)
    ends(sheet.enters.value_or(0));
  const double lands_later = scene.inflows.empty() ? 1 : 1.5;
  const double carried = std::max(all_carried_time(scene, first), running_time(scene, first));
  const double passed = std::max({passing_time(scene, first), turning_time(scene, first), lands_later * carried});
  until = std::max({until, drawing_time(scene, first), std::min(passed, longest_passing * until)});
  return std::isfinite(until) && until > 0 ? rounded(until) : 1;
}

// In which the first frame's sheet falls to the level of the bath [s].
double time_to_bath(const Scene& scene, const Frame& first) {
  const double height = height_above_bath(scene, first);
  return height > 0 ? std::sqrt(2 * height / scene.environment.gravity->norm()) : 0;
}

// When the last has ended, or come through: holds, inflows, keyframed motions, solids [s].
double ended_time(const Scene& scene, const Frame& first) {
  double time = coming_through_time(scene, first);
  const auto ends = [&](const scene::Motion& motion) {
    if (std::holds_alternative<scene::Keyframed>(motion))
      for (const double row : scene::events(motion))
        time = std::max(time, row);
  };
  for (const scene::Hold& hold : scene.holds) {
    time = std::max(time, hold.until.value_or(0));
    ends(hold.motion);
  }
  for (const scene::Solid& solid : scene.solids)
    ends(solid.motion);
  for (const scene::Inflow& inflow : scene.inflows)
    time = std::max(time, inflow.until.value_or(0));
  return time;
}

// The same, and when the last has changed of what goes on for ever, what turns has turned once, and what falls into a
// bath has come there [s].
double action_time(const Scene& scene, const Frame& first) {
  double time = std::max({ended_time(scene, first), passing_time(scene, first), time_to_bath(scene, first)});
  for (const double event : events_of(scene))
    time = std::max(time, event);
  return time;
}

// That of films where it gives 50 to 250 frames, else a round one that gives 50 to 125: so few that they do not rule
// the steps, each of which an output time ends. Up to that of films, and somewhat above 250 frames, where ten shall
// show what ends at the beginning (action_time).
double rate_of(double until, double action) {
  constexpr double film = 24, fewest = 50, most = 250, of_action = 10; // [1/s], frames
  const double rate = film * until >= fewest && film * until <= most ? film : round_number(fewest / until);
  const double wanted = action > 0 ? std::min({of_action / action, film, most / until}) : 0;
  return wanted > rate ? std::min(film, round_number(wanted)) : rate;
}

constexpr double as_long_again = 1.5; // of the time in which something ends: what shows it

bool few_show(double ended, double fps) {
  constexpr double enough = 5; // frames
  return ended > 0 && ended * fps < enough;
}

// Until everything has come to its end, or would blow up.
double whole_run(const Scene& with_heat, const Frame& first) {
  const double until = until_of(with_heat, first);
  const auto blow_up = blow_up_time_with_heat(with_heat, first);
  double end = blow_up ? std::min(until, rounded_down(before_blow_up * *blow_up)) : until;
  if (const auto meet = holds_meet(scene::as_it_starts(with_heat), first, end))
    end = std::min(end, rounded_down(before_holds_meet * meet->time));
  if (const auto meet = hold_in_solid(with_heat, first, end))
    end = std::min(end, rounded_down(before_holds_meet * meet->time));
  return end;
}

// Soon after the last solid has come through the sheet, where few frames of a whole run would show that: what then runs
// down for minutes is not what the scene is about.
std::optional<double> end_of_coming_through(const Scene& with_heat, const Frame& first, double whole) {
  const double through = coming_through_time(with_heat, first);
  const double end = through > 0 ? rounded(as_long_again * through) : 0;
  const bool last = ended_time(with_heat, first) <= through;
  return last && end < whole && few_show(through, rate_of(whole, action_time(with_heat, first))) ? std::optional(end)
                                                                                                 : std::nullopt;
}

std::string word_of_edges(const ProposedRing& ring) {
  return ring.folds
             ? "  Edges follow folds; sheet-remesh --smooth alone folds more coarsely, often in a third of the time;\n"
               "  without --min-edge more finely, in several times of it.\n"
             : "";
}

} // namespace

double landing_thickness(const Scene& scene, const Frame& first) {
  const auto x = positions(first);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < first.triangles; ++t) {
    const Corners& c = triangles(first)[t];
    least = std::min(least, volumes(first)[t] / TriangleArea(x[c[0]], x[c[1]], x[c[2]]).area);
  }
  for (std::size_t i = 0; i < scene.inflows.size(); ++i)
    least = std::min(least, thickness_after_fall(scene, first, i));
  return least;
}

ProposedRing proposed_ring(const Scene& with_heat, const Frame& first, const RingWishes& wishes) {
  const Scene scene = scene::as_it_starts(with_heat);
  const double whole = whole_run(with_heat, first);
  const auto soon = wishes.fps ? std::nullopt : end_of_coming_through(with_heat, first, whole);
  const double until = wishes.until.value_or(soon.value_or(whole));
  const auto folds = edges_in_folds(scene, first, wishes.quality);
  return {.until = until,
          .fps = wishes.fps.value_or(rate_of(until, action_time(with_heat, first))),
          .folds = folds,
          .stages = pipeline_at(scene, wishes.quality, folds)};
}

std::string few_frames_warning(const Scene& with_heat, const Frame& first, const RingWishes& wishes) {
  const double ended = ended_time(with_heat, first);
  const ProposedRing ring = proposed_ring(with_heat, first, wishes);
  if (const double whole = whole_run(with_heat, first); !wishes.until && ring.until < whole)
    return fmt::format(
        "the run ends at {} s, soon after what moves has come through: the sheet flows on, and --until {} "
        "shows that",
        ring.until, whole);
  if (wishes.fps || !few_show(ended, ring.fps) || as_long_again * ended > ring.until)
    return "";
  const double until = rounded(as_long_again * ended);
  return fmt::format("what moves has come through or ended by {:.2g} s, which {:.0f} of the frames show, as the run "
                     "goes on to {} s: --until {} --fps {} shows it",
                     ended, std::ceil(ended * ring.fps), ring.until, until, rate_of(until, ended));
}

std::string ring_text(const Scene& with_heat, const Frame& first, const RingWishes& wishes, const std::string& init) {
  const ProposedRing ring = proposed_ring(with_heat, first, wishes);
  const Scene scene = scene::as_it_starts(with_heat);
  const double longest = std::max(ring.until, until_of(with_heat, first));
  return fmt::format(
             "\nThe ring to run\n  {} -o first.sheet\n  sheet-loop -i first.sheet -o run.sheet --until {:.10g} "
             "--fps {:.10g} -- '{}'\n  Edges are {:.3g} m long in the mean. Steps are chosen such that their error "
             "is below {:g} of an edge:\n  sheet-step --tolerance asks for another one, --dt for fixed steps.\n",
             init, ring.until, ring.fps, ring.stages, scene::mean_edge(first), tolerance_at(wishes.quality)) +
         forecast_text(scene, first, ring, tolerance_at(wishes.quality)) + word_of_blow_up(with_heat, first) +
         word_of_holds_that_meet(scene, first, longest) + word_of_hold_in_solid(scene, first, longest) +
         word_of_runaway(with_heat, first) + word_of_edges(ring);
}

std::string ring_lines(const Scene& with_heat, const Frame& first, const RingWishes& wishes, const std::string& init) {
  const ProposedRing ring = proposed_ring(with_heat, first, wishes);
  const Scene scene = scene::as_it_starts(with_heat);
  return fmt::format("first {}\nuntil {:.10g}\nfps {:.10g}\nstages {}\n", init, ring.until, ring.fps, ring.stages) +
         forecast_lines(forecast(scene, first, ring, tolerance_at(wishes.quality)));
}

} // namespace sheet
