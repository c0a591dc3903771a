// SPDX-License-Identifier: GPL-3.0-or-later
// A step of a given length, and what is done where it does not converge: without arcs, then in halves, halves by
// backward Euler, and, when Newton's iterations are spent, unfinished (docs/hard-cases.md).
#include <algorithm>
#include <cmath>

#include "libsheet/base/error.h"
#include "libsheet/energy/leaning.h"
#include "libsheet/energy/overshoot.h"
#include "libsheet/solve/step.h"

namespace sheet {

namespace {

constexpr int halvings_before_euler = 1;

} // namespace

StepReport Stepper::step(State& state, double dt) {
  if (!(dt > 0) || !std::isfinite(dt))
    fail(ExitCode::usage, "a time step of {} s is not possible", dt);
  StepReport report;
  clear_times();
  State next = state;
  limit_leaning(next, model_.holds);
  // In equal parts, if something moves far along a wall.
  const double until = state.time + dt;
  for (double left = dt; left > 0; left = until - next.time) {
    const double longest = longest_step_on_walls(model_.walls, next);
    const double count = std::ceil(std::max(1.0, left / longest * (1 - 1e-9)));
    advance(next, left / count, 0, Estimate::plain, report);
    if (count == 1)
      break;
  }
  next.time = state.time + dt;
  state = std::move(next);
  tell_times(report);
  return report;
}

void Stepper::advance(State& state, double dt, int depth, Estimate estimate, StepReport& report) {
  if (depth == 0 && arcs_rest_ && has_arcs()) {
    advance_flat(state, dt, report);
    return;
  }
  State end;
  const Outcome outcome = attempt(state, dt, options_.scheme, Demand::converged, estimate, end, report);
  if (outcome == Outcome::done) {
    ++report.substeps;
    state = std::move(end);
    return;
  }
  ++report.failed;
  if (!state.to_make_up.empty()) {
    forget_overshoot(state);
    advance(state, dt, depth, estimate, report);
    return;
  }
  if (depth == 0 && outcome == Outcome::not_converged && has_arcs()) {
    advance_flat(state, dt, report);
    return;
  }
  const bool too_far = outcome == Outcome::slides_too_far;
  const bool exhausted = report.newton.spent() >= options_.iterations;
  if (!exhausted && !too_far && options_.scheme != Scheme::backward_euler && depth >= halvings_before_euler &&
      attempt(state, dt, Scheme::backward_euler, Demand::converged, estimate, end, report) == Outcome::done) {
    ++report.substeps;
    ++report.euler_fallbacks;
    state = std::move(end);
    return;
  }
  const bool divisible = depth < options_.retries;
  if (((exhausted && !too_far) || !divisible) &&
      attempt(state, dt, Scheme::backward_euler, Demand::lower_potential, estimate, end, report) == Outcome::done) {
    ++report.substeps;
    ++report.unfinished;
    state = std::move(end);
    return;
  }
  if (divisible && report.newton.spent() < hopeless_iterations()) {
    const double middle = state.time + 0.5 * dt, until = state.time + dt;
    advance(state, middle - state.time, depth + 1, estimate, report);
    advance(state, until - state.time, depth + 1, estimate, report);
    return;
  }
  fail(ExitCode::not_converged,
       "the step at t = {} s did not converge, not even with dt = {} s ({} Newton iterations, the last of {:.2g} edge "
       "lengths)",
       state.time, dt, report.newton.iterations, report.newton.last_step);
}

void Stepper::advance_flat(State& state, double dt, StepReport& report) {
  report += without_arcs().step(state, dt);
  without_arcs().clear_times(); // they are told
  ++report.flat_fallbacks;
}

} // namespace sheet
