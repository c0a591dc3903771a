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
constexpr double as_extrapolated = 1e-6; // of an edge: held unknowns that are where inertia takes them
constexpr double of_next = 0.01;         // rest rate: each one over that before
// Of the greatest force, where what yields has been solved for at once; of a sheet that moves, where the step's error
// is the measure.
constexpr double force_left = 1e-3, force_left_moving = 0.03, force_left_by_error = 0.1;
constexpr double moving = 0.01; // strain rate, over that at which the liquid yields
constexpr int at_once = 5;      // iterations, of such an attempt

// How far what is held is from where inertia takes it, in edges. What a vertex overshot (energy/overshoot.h) does not
// count: that the sheet lags behind it is no sign of another start.
double farthest_behind(const Stage& stage, Eigen::VectorXd behind, const Eigen::VectorXd& scale) {
  const std::vector<Vector3>& overshoot = stage.start->overshoot;
  for (std::size_t v = 0; v < overshoot.size(); ++v)
    if (!overshoot[v].isZero(0))
      behind.segment<3>(static_cast<Eigen::Index>(3 * v)).setZero();
  return behind.cwiseQuotient(scale).cwiseAbs().maxCoeff();
}

// Of the warmest triangle [s].
double longest_reduced_time(const Stage& stage) {
  return stage.shift.empty() ? stage.duration : stage.duration / *std::ranges::min_element(stage.shift);
}

} // namespace

StageSolve::StageSolve(LinearSystem& system, const Terms& terms, const std::vector<Hold>& holds,
                       const Eigen::VectorXd& scale, const NewtonOptions& options, Demand demand)
    : system_(system), terms_(terms), holds_(holds), scale_(scale), options_(options), demand_(demand) {}

// The one of lowest potential, if below `least`: the last known state, the sheet moved rigidly with what is held, and,
// if what is held has left the others behind, the linear response to its motion.
bool StageSolve::find_lower(const Stage& stage, const Unknowns& safe, bool left_behind, double least, Unknowns& u) {
  bool found = false;
  const auto consider = [&](const Unknowns& trial) {
    const double potential = system_.value(terms_, trial).value;
    if (potential < least || !std::isfinite(least)) {
      least = potential;
      u = trial;
      found = true;
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
  if (left_behind) {
    trial = safe;
    if (system_.spread_held_motion(terms_, target, trial))
      consider(trial);
  }
  return found;
}

// What is prescribed.
void StageSolve::place(const Stage& stage, Unknowns& u) const {
  place_held(holds_, stage, stage.end_time, u);
  place_on_walls(stage, system_.constraints().held, u);
}

// What yields is begun as if it did so softly, an iteration each at rest rates that fall to its own: a sheet at rest is
// so stiff under a load that its first direction is shorter than any rule for stopping, though it flows in the end.
void StageSolve::come_from_softer(const Stage& stage, const Unknowns& guess, const NewtonOptions& options,
                                  NewtonReport& report, Unknowns& u) {
  const auto rest_at = [&](std::span<const double> rates) {
    for (const auto& term : terms_)
      term->rest_at(rates);
  };
  std::vector<double> rest, rates;
  for (const StageLiquid& of : stage.liquids) {
    rest.push_back(rest_rate(of.liquid));
    rates.push_back(softest * yield_rate(of.liquid));
  }
  const auto softer = [&] { return std::ranges::mismatch(rates, rest, std::ranges::less_equal{}).in1 != rates.end(); };
  NewtonOptions once = options;
  once.iterations = 1;
  while (softer()) {
    std::vector<double> now = rest;
    for (std::size_t i = 0; i < now.size(); ++i)
      now[i] = std::max(rest[i], rates[i]);
    rest_at(now);
    system_.forget_factor();
    report += minimize(system_, terms_, scale_, guess, once, evaluate_first(system_, terms_, u), u);
    for (double& rate : rates)
      rate *= of_next;
  }
  rest_at(rest);
  system_.forget_factor();
}

// What yields and rests, or flows on much as before, needs no more than other liquids. That the forces have fallen,
// too, tells rest from a sheet that is about to flow: by the theorem of the lower bound of limit analysis what balances
// the load below yield rests [Hill 1950, chapter III].
bool StageSolve::solve_at_once(const Stage& stage, const Unknowns& guess, FirstEvaluation first, NewtonOptions options,
                               NewtonReport& report, Unknowns& u) {
  options.iterations = std::min(options.iterations, at_once);
  const Eigen::Index positions = 3 * static_cast<Eigen::Index>(stage.vertices());
  const double way = (guess - stage.begin).cwiseQuotient(scale_).head(positions).lpNorm<Eigen::Infinity>();
  double least = std::numeric_limits<double>::infinity();
  for (const StageLiquid& of : stage.liquids)
    if (of.liquid.law.yields())
      least = std::min(least, yield_rate(of.liquid));
  const bool moves = way > moving * least * longest_reduced_time(stage);
  options.force_left = moves ? force_left_moving : force_left;
  options.force_left_by_error = moves ? force_left_by_error : force_left;
  const NewtonReport r = minimize(system_, terms_, scale_, guess, options, std::move(first), u);
  report += r;
  return r.converged;
}

bool StageSolve::solve(const Stage& stage, const Unknowns& guess, const Unknowns& safe, int iterations,
                       NewtonReport& report, Unknowns& u) {
  NewtonOptions newton = options_;
  if (demand_ == Demand::converged)
    newton.iterations = std::min(newton.iterations, iterations);
  if (newton.iterations <= 0)
    return false;
  newton.renews = std::ranges::any_of(stage.liquids, [](const StageLiquid& of) { return !of.flow.newtonian(); });
  for (const auto& term : terms_)
    term->begin(stage);
  // The extrapolated state is nearly always the best start, which Newton's first direction tells, unless what is held
  // leads the sheet elsewhere.
  Stopwatch watch;
  u = guess;
  place(stage, u);
  const double left = farthest_behind(stage, u - guess, scale_);
  const bool left_behind = left >= far_behind;
  const auto lower = [&](double least, Unknowns& start) { return find_lower(stage, safe, left_behind, least, start); };
  FirstEvaluation first = evaluate_first(system_, terms_, u);
  OtherStart other = lower;
  if (left > as_extrapolated) {
    const bool found = lower(first.energy.value, u);
    if (found || left_behind) // what answered the held motion has left another Hessian
      first = evaluate_first(system_, terms_, u);
    other = {};
  }
  report.seconds_assembly += watch.lap();
  if (std::ranges::any_of(stage.liquids, [](const StageLiquid& of) { return of.liquid.law.yields(); })) {
    const Unknowns start = u;
    if (solve_at_once(stage, guess, std::move(first), newton, report, u))
      return true;
    u = start;
    for (const auto& term : terms_)
      term->begin(stage);
    come_from_softer(stage, guess, newton, report, u);
    first = evaluate_first(system_, terms_, u);
    other = {};
  }
  NewtonReport r = minimize(system_, terms_, scale_, guess, newton, std::move(first), u, other);
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
