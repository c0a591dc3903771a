// SPDX-License-Identifier: GPL-3.0-or-later
// A step chosen by its error, and what is done where none is accurate enough or none converges (docs/hard-cases.md).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "libsheet/base/error.h"
#include "libsheet/energy/leaning.h"
#include "libsheet/energy/overshoot.h"
#include "libsheet/solve/step.h"

namespace sheet {

namespace {

constexpr double safety = 0.9, least_factor = 0.2, greatest_factor = 4; // factors from one step to the next
constexpr double much_shorter = 1e-3, helped = 0.3; // a step that much shorter shall have that part of the error

constexpr double crossed = 1e-4; // of an edge: steps in which the sheet goes less are not tried

double mean_edge(const State& state) {
  double lengths = 0;
  for (const Edge& e : state.mesh->edges)
    lengths += (state.positions[e[1]] - state.positions[e[0]]).norm();
  return lengths / static_cast<double>(state.mesh->edges.size());
}

// Steps chosen by their error are not shorter: the time in which the sheet crosses 1e-4 of an edge, at its speed and as
// it falls, or a thousandth of what is left [s]. (By its speed alone what starts at rest would fall for that.)
double shortest_step(const Model& model, const State& state, double edge, double left) {
  double squares = 0;
  for (const Vector3& v : state.velocities)
    squares += v.squaredNorm();
  const double speed = std::sqrt(squares / static_cast<double>(state.velocities.size()));
  const double way = crossed * edge, fall = model.has_inertia() ? model.gravity.norm() : 0;
  return std::min(2 * way / (speed + std::sqrt(speed * speed + 2 * fall * way)), 1e-3 * left);
}

// The same at the mean speed of a step that was too long: other forces than weight throw what starts at rest, too [s].
double shortest_step(const State& start, const State& end, double edge, double dt) {
  double squares = 0;
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    squares += (end.positions[v] - start.positions[v]).squaredNorm();
  const double way = std::sqrt(squares / static_cast<double>(start.positions.size()));
  return way > 0 ? dt * crossed * edge / way : dt;
}

} // namespace

class Stepper::ChosenStep {
public:
  ChosenStep(Stepper& stepper, State& state, double remaining, const StepControl& control, StepReport& report)
      : stepper_(stepper), state_(state), remaining_(remaining), tolerance_(control.tolerance),
        wanted_(control.dt > 0 ? control.dt : remaining), edge_(mean_edge(state)), report_(report) {
    wanted_ = std::min(wanted_, longest_step_on_walls(stepper.model_.walls, state));
    // No sliver of a step before the output time: two equal steps instead.
    first_ = wanted_ >= remaining ? remaining : wanted_ > 0.5 * remaining ? 0.5 * remaining : wanted_;
    shortest_ = std::min(shortest_step(stepper.model_, state, edge_, remaining), first_);
  }

  void find() {
    try_shorter();
    if (!best_ && too_short_)
      take_shortest();
    if (!best_)
      take_unfinished();
    if (leads_nowhere(best_->dt))
      fail_of_nothing();
    report_.inaccurate = report_.unfinished == 0 && best_->error > tolerance_;
    report_.error = best_->error;
    report_.worst = best_->worst;
    report_.reactions = std::move(best_->reactions);
    report_.flat_fallbacks = best_->flat;
    ++report_.substeps;
  }

  // The next step to try.
  [[nodiscard]] double next() const {
    const bool as_it_was = report_.unfinished > 0 || jumps_;
    const double factor =
        as_it_was ? 1 : std::clamp(safety * std::sqrt(tolerance_ / best_->error), least_factor, greatest_factor);
    // A step that was cut to land says nothing against the longer one that was wanted; one that was shortened does.
    const bool shortened = !as_it_was && best_->dt < first_;
    const double as_wanted = factor >= 1 && !shortened ? std::min(wanted_, greatest_factor * best_->dt) : 0.0;
    return std::max(shortest_, std::min(std::max(best_->dt * factor, as_wanted), best_->dt * safety * best_->room));
  }

  [[nodiscard]] bool lands() const { return best_->dt >= remaining_; }
  [[nodiscard]] State& end() { return best_->end; }

private:
  struct Trial {
    State end;
    double dt = 0, error = 0;
    std::size_t worst = 0;
    bool flat = false;
    HoldingForces reactions;
    double room = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] bool leads_nowhere(double dt) const { return state_.time + dt == state_.time; }

  // Until one is accurate enough, none can be, or the iterations are spent.
  void try_shorter() {
    Trial trial;
    trial.dt = first_;
    std::optional<Trial> longest; // that converged
    for (int tries = 0; !best_ || best_->error > tolerance_; ++tries) {
      too_short_ = trial.dt < shortest_;
      if (too_short_ || tries > 4 * stepper_.options_.retries || leads_nowhere(trial.dt) ||
          report_.newton.spent() >= stepper_.options_.iterations)
        return;
      report_.error = 0;
      if (stepper_.attempt_either(state_, trial.dt, trial.end, trial.flat, report_) != Outcome::done) {
        ++report_.failed;
        if (state_.to_make_up.empty())
          trial.dt *= report_.room < 1 ? std::max(least_factor, safety * report_.room) : least_factor;
        else
          forget_overshoot(state_);
        continue;
      }
      note(trial);
      if (trial.error > tolerance_) {
        ++report_.rejected;
        shortest_ = std::min(shortest_, shortest_step(state_, trial.end, edge_, trial.dt));
      }
      // What was overshot is the same in a shorter step, down to that in which it was: where it is more than the sheet
      // can take, it is given up.
      if (best_ && !state_.to_make_up.empty() && trial.error > tolerance_ &&
          trial.error / trial.dt > best_->error / best_->dt) {
        forget_overshoot(state_);
        best_.reset();
        longest.reset();
        trial.dt = first_;
        continue;
      }
      if (!best_ || trial.error < best_->error)
        best_ = trial;
      if (!longest)
        longest = trial;
      if (trial.dt <= much_shorter * longest->dt && trial.error > helped * longest->error) {
        best_ = longest;
        jumps_ = true;
        return;
      }
      trial.dt *= std::clamp(safety * std::sqrt(tolerance_ / trial.error), least_factor, safety);
    }
  }

  // As a fixed step is done.
  void take_shortest() {
    Trial trial{state_, shortest_, 0, 0, false, {}};
    report_.error = 0;
    stepper_.advance(trial.end, shortest_, 0, Estimate::filtered, report_);
    trial.flat = report_.flat_fallbacks > 0;
    note(trial);
    best_ = std::move(trial);
    --report_.substeps; // find() counts it
  }

  void take_unfinished() {
    Stepper& last = stepper_.has_arcs() ? stepper_.without_arcs() : stepper_;
    Trial trial{{}, first_, 0, 0, stepper_.has_arcs(), {}};
    report_.error = 0;
    while (last.attempt(state_, trial.dt, Scheme::backward_euler, Demand::lower_potential, Estimate::filtered,
                        trial.end, report_) != Outcome::done) {
      ++report_.failed;
      trial.dt *= least_factor;
      report_.error = 0;
      if (report_.newton.spent() >= stepper_.hopeless_iterations() || leads_nowhere(trial.dt))
        fail(ExitCode::not_converged, "the step at t = {} s did not converge ({} Newton iterations, last tried {} s)",
             state_.time, report_.newton.iterations, trial.dt);
    }
    note(trial);
    ++report_.unfinished;
    best_ = std::move(trial);
  }

  // What the report says of the last attempt.
  void note(Trial& trial) const {
    trial.error = report_.error;
    trial.room = report_.room;
    trial.worst = report_.worst;
    trial.reactions = report_.reactions;
  }

  [[noreturn]] void fail_of_nothing() const {
    const Vector3& x = state_.positions[best_->worst];
    fail(
        ExitCode::not_converged,
        "the steps have come down to nothing at t = {} s: the sheet changes faster and faster there, most at vertex {} "
        "({:.4g}, {:.4g}, {:.4g}) m; the flow may have no later state (a film that bursts), else shorter edges there "
        "may help",
        state_.time, best_->worst, x.x(), x.y(), x.z());
  }

  Stepper& stepper_;
  State& state_;
  double remaining_, tolerance_, wanted_, edge_;
  StepReport& report_;
  double first_ = 0, shortest_ = 0; // to be tried
  std::optional<Trial> best_;       // of those that converged
  bool jumps_ = false;              // shorter steps do not help
  bool too_short_ = false;          // the next one would be
};

StepReport Stepper::step_within(State& state, double until, StepControl& control) {
  const double remaining = until - state.time;
  if (!(remaining > 0) || !std::isfinite(remaining))
    fail(ExitCode::usage, "cannot step from t = {} s to {} s", state.time, until);
  if (!(control.tolerance > 0))
    fail(ExitCode::usage, "--tolerance: {} is not above 0", control.tolerance);
  limit_leaning(state, model_.holds);
  StepReport report;
  clear_times();
  ChosenStep chosen(*this, state, remaining, control, report);
  chosen.find();
  control.dt = chosen.next();
  const bool lands = chosen.lands();
  state = std::move(chosen.end());
  if (lands)
    state.time = until;
  tell_times(report);
  return report;
}

} // namespace sheet
