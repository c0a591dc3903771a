// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/step_stage.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "formats/cpp/stream_writer.h"
#include "libsheet/base/error.h"
#include "libsheet/base/file_roles.h"
#include "libsheet/base/files.h"
#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/base/stopwatch.h"
#include "libsheet/base/whole_file.h"
#include "libsheet/energy/term_table.h"
#include "libsheet/health/teller.h"
#include "libsheet/scene/frame_heat.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/scene/rolls.h"
#include "libsheet/sheet/frame_mesh.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solve/arc_rest.h"
#include "libsheet/solve/drop_flight.h"
#include "libsheet/solve/impossible_speed.h"
#include "libsheet/solve/pressure_laws.h"
#include "libsheet/solve/scene_model.h"

namespace sheet {

using formats::Frame;

namespace {

// What the whole run took.
struct Totals {
  std::uint64_t steps = 0;
  StepReport all;
  double seconds = 0;

  void add(const StepReport& report, double elapsed) {
    ++steps;
    all += report;
    seconds += elapsed;
  }
};

// Of the error of a step, what Newton's iterations may add (docs/speed-error.md).
constexpr double part_of_step_error = 0.05;

void check_mesh(const Connectivity& mesh) {
  std::vector<bool> used(mesh.vertices);
  for (const Corners& t : mesh.triangles)
    for (const std::uint32_t v : t)
      used[v] = true;
  const auto lonely = std::find(used.begin(), used.end(), false);
  if (lonely != used.end())
    fail(ExitCode::bad_input, "vertex {} belongs to no triangle, so it has no mass and no place: remove it",
         lonely - used.begin());
}

// An edge without length has no direction, and one that is too short for its square to be a number is no better.
void check_edges(const Frame& frame, const Connectivity& mesh) {
  constexpr double shortest = 1e-30; // [m]
  const auto x = positions(frame);
  for (const auto& [a, b] : mesh.edges)
    if (const double length = (x[b] - x[a]).norm(); !(length > shortest))
      fail(ExitCode::bad_input,
           "vertices {} and {} share an edge and lie in one place ({:g} m apart): let sheet-remesh collapse it", a, b,
           length);
}

// Liquid that flows on solids has to know their surfaces, and so has what sticks to belts, which run along them, and
// what is squeezed between two, what takes heat, and what they may close as it encloses gas.
bool needs_surfaces(const Scene& scene) {
  return flows_on_solids(scene) || solids_squeeze(scene) ||
         ((scene.heat || encloses_gas(scene)) && !scene.solids.empty()) ||
         std::ranges::any_of(scene.solids, [](const scene::Solid& solid) { return !solid.surface_velocity.isZero(0); });
}

// The slope at a clamp is that of a director; hinges have none.
void check_bending(const Scene& scene, Bending bending) {
  if (bending == Bending::mid_edge || !scene.model.bending)
    return;
  for (std::size_t i = 0; i < scene.holds.size(); ++i)
    if (scene.holds[i].clamped)
      fail(ExitCode::usage,
           "--bending: hinges do not hold the slope that [[hold]] number {} (from 0) clamps; take --bending mid-edge, "
           "or kind = \"pinned\"",
           i);
}

constexpr const char* how_far =
    "without --dt the frame must say how far to go: let sheet-loop stamp it (--until, --fps), or give --dt";

// The end of a fixed step from t: dt, or a little less so that equal steps land exactly on `until`.
double fixed_step(double t, double until, double dt) {
  if (std::isinf(until))
    return dt;
  const double left = until - t;
  const double count = std::max(1.0, std::ceil(left / dt * (1 - 1e-9)));
  return left / count;
}

} // namespace

struct StepStage::Impl {
  StepStageOptions options;
  FrameScene scenes;
  FrameMesh mesh;
  std::shared_ptr<const solid::Solids> solids; // if something needs their surfaces
  std::optional<Stepper> stepper;
  Totals totals;
  health::Teller teller;

  [[nodiscard]] static double end_of_step(const Scene& scene, const Frame& frame) {
    double until = next_event(scene, frame.time);
    const double output = number(frame, "next_output_time", std::numeric_limits<double>::infinity());
    if (output > frame.time)
      until = std::min(until, output);
    return until;
  }

  // What the step is computed with; whom the rolls hold is set. Errors as StepStage::check.
  Model prepare(Frame& frame) {
    check_magnitudes(frame);
    const Scene& scene = scenes.of(frame);
    if (scenes.changed())
      solids = needs_surfaces(scene) ? std::make_shared<const solid::Solids>(scene) : nullptr;
    if (mesh.follow(frame))
      check_mesh(*mesh.mesh());
    check_edges(frame, *mesh.mesh());
    scene::check_temperatures(scene, frame);
    (void)scene::FrameLiquids(scene, frame); // refuses what is of no liquid
    check_bending(scene, options.bending);
    if (mesh.mesh()->triangles.empty())
      fail(ExitCode::bad_input, "the sheet has no triangles: there is nothing to step");
    scene::follow_rolls(scene, frame);
    // Arcs reduce locking where the sheet bends by directors (docs/hard-cases.md says what they cost).
    constexpr bool arcs = true;
    return model_of(scene, frame, *mesh.mesh(), options.bending, arcs, solids);
  }

  // Where all of the sheet has left, time goes on, and drops fly.
  void pass_time(Frame& frame) {
    check_magnitudes(frame);
    const Scene& scene = scenes.of(frame);
    const double start = frame.time, until = end_of_step(scene, frame);
    if (!options.dt && std::isinf(until))
      fail(ExitCode::usage, how_far);
    const double end = options.dt ? start + fixed_step(start, until, *options.dt) : until;
    frame.put(formats::make_standard_array("start_position", 0));
    put_number(frame, "start_time", start);
    frame.time = end >= until * (1 - 1e-15) ? until : end;
    ++frame.step;
    fly_drops(frame, scene, start);
  }

  void set_model(Model model) {
    if (stepper) {
      stepper->set_model(std::move(model));
      return;
    }
    StepOptions step_options;
    step_options.scheme = options.scheme;
    step_options.newton.of_step_error = part_of_step_error;
    if (options.tolerance) // of a step's error Newton's iterations add a hundredth at most
      step_options.newton.tolerance = std::min(step_options.newton.tolerance, 0.01 * *options.tolerance);
    if (!options.dt)
      step_options.newton.step_error = options.tolerance.value_or(default_tolerance);
    stepper.emplace(std::move(model), step_options);
  }

  // By one step, until `until` at most; one that is chosen begins with `wanted` [s], and the frame is told of the next.
  StepReport go_on(Frame& frame, double until, double wanted, State& state) {
    if (options.dt) {
      const double dt = fixed_step(frame.time, until, *options.dt);
      const bool lands = frame.time + dt >= until * (1 - 1e-15);
      StepReport report = stepper->step(state, dt);
      if (lands)
        state.time = until;
      return report;
    }
    if (std::isinf(until))
      fail(ExitCode::usage, how_far);
    StepControl control{.tolerance = options.tolerance.value_or(default_tolerance), .dt = wanted};
    StepReport report = stepper->step_within(state, until, control);
    put_number(frame, "step_size", control.dt);
    return report;
  }

  void step(Frame& frame) {
    if (frame.triangles == 0 && frame.step > 0)
      return pass_time(frame);
    Model model = prepare(frame);
    const double until = end_of_step(scenes.of(frame), frame);
    set_model(std::move(model));
    State start = state_of(frame, mesh.mesh());
    make_up_for_overshoot(frame, stepper->model(), start);
    settle_gas(stepper->model().pressures, start.gas);
    ArcRest rest(frame);
    stepper->rest_arcs(rest.rests());
    Stopwatch watch;
    State state = start;
    const double wanted = number(frame, "step_size", 0);
    StepReport report = go_on(frame, until, wanted, state);
    if (!start.to_make_up.empty() && impossible_speed(stepper->model(), start, state)) { // more than the sheet can take
      forget_overshoot(start);
      state = start;
      report = go_on(frame, until, wanted, state);
    }
    const double elapsed = watch.lap();
    totals.add(report, elapsed);
    log::detail("step {}: t = {:.6g} s, dt = {:.4g} s, {} Newton iterations, error {:.2e} of an edge, most at vertex "
                "{}, {:.1f} ms",
                frame.step + 1, state.time, state.time - frame.time, report.newton.iterations, report.error,
                report.worst, 1e3 * elapsed);
    if (report.unfinished > 0)
      teller.tell(frame,
                  {.trouble = health::Trouble::not_converged,
                   .value = static_cast<double>(report.unfinished),
                   .amount = static_cast<double>(report.unfinished)},
                  fmt::format("step {}: {} of its {} parts taken before Newton's iterations had converged: stable, but "
                              "less accurate; shorter steps or remeshing help",
                              frame.step + 1, report.unfinished, report.substeps));
    else if (report.inaccurate > 0)
      warn_of_inaccurate(frame, state, report);
    refuse_impossible_speed(frame, start, state);
    rest.note(report.flat_fallbacks > 0);
    rest.put(frame);
    put_state(state, frame);
    tell_of_gas(start, frame);
    fly_drops(frame, scenes.of(frame), start.time);
    put_heat_moved(state, frame);
    put_reactions(report.reactions, scene::wants_forces(scenes.of(frame)), scenes.of(frame).solids.size(), frame);
  }

  void refuse_impossible_speed(const Frame& frame, const State& start, const State& end) const {
    const auto impossible = impossible_speed(stepper->model(), start, end);
    if (!impossible)
      return;
    const Vector3& x = end.positions[impossible->vertex];
    fail(
        ExitCode::not_converged,
        "step {}: vertex {} at ({:.4g}, {:.4g}, {:.4g}) m flies at {:.3g} m/s, with a kinetic energy of {:.3g} J, more "
        "than all that worked on the whole sheet can have given, {:.3g} J: its place is impossible for the model "
        "(triangles crushed, or solids that leave no room); remesh, tear, or shorten edges there",
        frame.step + 1, impossible->vertex, x.x(), x.y(), x.z(), end.velocities[impossible->vertex].norm(),
        impossible->energy, impossible->work);
  }

  // That it escapes, from the widest hole of each enclosure.
  void tell_of_gas(const State& start, Frame& frame) {
    put_gas_holes(stepper->model().pressures, frame);
    const std::vector<Gas> gas = gas_of(frame);
    for (const PressureLaw& law : stepper->model().pressures)
      if (const double hole = law.gas.hole; hole > 0)
        teller.tell(
            frame,
            {.trouble = health::Trouble::gas_escapes,
             .value = hole,
             .amount = gas[law.number].escaped - (law.number < start.gas.size() ? start.gas[law.number].escaped : 0),
             .place = law.hole_place},
            fmt::format("step {}: gas escapes through holes of {:.3g} m^2, the widest about ({:.4g}, {:.4g}, "
                        "{:.4g}) m",
                        frame.step, hole, law.hole_place.x(), law.hole_place.y(), law.hole_place.z()));
  }

  // state: at the end of the step.
  void warn_of_inaccurate(Frame& frame, const State& state, const StepReport& report) {
    const Vector3& x = state.positions[report.worst];
    teller.tell(
        frame, {.trouble = health::Trouble::above_tolerance, .value = report.error, .place = x},
        fmt::format(
            "step {}: its error is about {:.2g} of an edge length, above the tolerance, most at vertex {} ({:.4g}, "
            "{:.4g}, {:.4g}) m: no step from t = {:.6g} s keeps to it; shorter edges there may help",
            frame.step + 1, report.error, report.worst, x.x(), x.y(), x.z(), frame.time));
  }
};

StepStage::StepStage(StepStageOptions options) : impl_(std::make_unique<Impl>()) {
  if (options.dt && !(*options.dt > 0 && std::isfinite(*options.dt)))
    fail(ExitCode::usage, "--dt: {} is not a positive time", *options.dt);
  if (options.tolerance && !(*options.tolerance > 0 && std::isfinite(*options.tolerance)))
    fail(ExitCode::usage, "--tolerance: {} is not a positive number", *options.tolerance);
  if (options.dt && options.tolerance)
    fail(ExitCode::usage, "--dt and --tolerance exclude each other: a step is fixed or chosen by its error");
  impl_->options = std::move(options);
}

StepStage::~StepStage() = default;

void StepStage::check(const Frame& frame) {
  Frame copy = frame;
  const Model model = impl_->prepare(copy);
  (void)make_terms(model, impl_->mesh.mesh());
}

void StepStage::step(Frame& frame) {
  try {
    impl_->step(frame);
  } catch (const Error& error) {
    const std::string& path = impl_->options.failed;
    if (error.code() != ExitCode::not_converged || path.empty())
      throw;
    std::string place = "is in " + path;
    try {
      release_file(path, FileRole::output);
      write_whole_file(path, [&](OutputFile& file) {
        file.start();
        formats::StreamWriter writer(file.descriptor(), file.name());
        writer.write(frame);
        writer.end();
      });
    } catch (const std::exception& failure) { // which must not hide why the step failed
      place = fmt::format("could not be kept: {}", failure.what());
    }
    fail(error.code(), "{}; the frame before it {}", error.what(), place);
  }
}

void StepStage::report() const {
  const auto& [steps, t, seconds] = impl_->totals;
  impl_->teller.report();
  if (steps == 0)
    return;
  log::detail("{} steps ({} substeps, {} failed, {} rejected, {} by backward Euler, {} without arcs, {} unfinished, "
              "{} above the tolerance), {} Newton iterations, {:.3g} s",
              steps, t.substeps, t.failed, t.rejected, t.euler_fallbacks, t.flat_fallbacks, t.unfinished, t.inaccurate,
              t.newton.iterations, seconds);
  log::detail(
      "  analysis {:.1f} %, assembly {:.1f} %, factorisation {:.1f} %, solution {:.1f} %, line search {:.1f} % of it; "
      "{} factorisations, {} products with the Hessian, {} steps by the factor alone",
      100 * t.seconds_analysis / seconds, 100 * t.newton.seconds_assembly / seconds,
      100 * t.newton.seconds_factor / seconds, 100 * t.newton.seconds_solve / seconds,
      100 * t.newton.seconds_search / seconds, t.newton.factorizations, t.newton.products, t.newton.followed);
  for (const TermTime& term : t.terms)
    log::detail("  term {:<40} {:8.3f} s {:5.1f} %", term.name, term.seconds, 100 * term.seconds / seconds);
}

} // namespace sheet
