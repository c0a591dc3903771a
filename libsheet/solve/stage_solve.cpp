// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/stage_solve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/base/stopwatch.h"
#include "libsheet/solve/damped_newton.h"

namespace sheet {

namespace {
constexpr double unfinished_gain = 1e-2; // part of what it gained that an unfinished solve may still promise to gain
constexpr double far_behind = 0.1;       // of an edge: held unknowns that are this far from where inertia takes them
} // namespace

StageSolve::StageSolve(LinearSystem& system, const Terms& terms, const std::vector<Hold>& holds,
                       const Eigen::VectorXd& scale, const NewtonOptions& options, Demand demand)
    : system_(system), terms_(terms), holds_(holds), scale_(scale), options_(options), demand_(demand) {}

// The one of lowest potential among the extrapolated state, the last known one, the sheet moved rigidly with what is
// held, and, if what is held leaves the others behind, the linear response to its motion.
Unknowns StageSolve::starting_guess(const Stage& stage, const Unknowns& guess, const Unknowns& safe,
                                    FirstEvaluation& first) {
  Unknowns best = guess;
  place(stage, best);
  first = evaluate_first(system_, terms_, best); // nearly always the one
  const double left_behind = (best - guess).cwiseQuotient(scale_).cwiseAbs().maxCoeff();
  double least = first.energy.value;
  bool is_first = true;
  const auto consider = [&](const Unknowns& u) {
    const double potential = system_.value(terms_, u).value;
    if (potential < least || !std::isfinite(least)) {
      least = potential;
      best = u;
      is_first = false;
    }
  };
  Unknowns trial = safe;
  place(stage, trial);
  const Unknowns target = trial;
  consider(trial);
  if (move_with_held(holds_, stage, stage.end_time, trial)) {
    place(stage, trial);
    consider(trial);
  }
  if (left_behind >= far_behind) {
    trial = safe;
    is_first = false; // the Hessian is then another
    if (system_.spread_held_motion(terms_, target, trial))
      consider(trial);
  }
  if (!is_first)
    first = evaluate_first(system_, terms_, best);
  return best;
}

// What is prescribed.
void StageSolve::place(const Stage& stage, Unknowns& u) const {
  place_held(holds_, stage, stage.end_time, u);
  place_on_walls(stage, system_.constraints().held, u);
}

bool StageSolve::solve(const Stage& stage, const Unknowns& guess, const Unknowns& safe, int iterations,
                       NewtonReport& report, Unknowns& u) {
  NewtonOptions newton = options_;
  if (demand_ == Demand::converged)
    newton.iterations = std::min(newton.iterations, iterations);
  if (newton.iterations <= 0)
    return false;
  for (const auto& term : terms_)
    term->begin(stage);
  Stopwatch watch;
  FirstEvaluation first;
  u = starting_guess(stage, guess, safe, first);
  report.seconds_assembly += watch.lap();
  NewtonReport r = minimize(system_, terms_, scale_, guess, newton, std::move(first), u);
  report += r;
  if (r.converged || demand_ == Demand::converged)
    return r.converged;
  double gained = r.gained;
  const auto good_enough = [&] { return gained > 0 && r.promised <= unfinished_gain * gained; };
  if (good_enough())
    return true;
  r = minimize_damped(system_, terms_, scale_, newton, u);
  report += r;
  gained += r.gained;
  return r.converged || good_enough();
}

} // namespace sheet
