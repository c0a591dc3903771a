// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/solve/newton.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "libsheet/base/stopwatch.h"
#include "libsheet/linear/conjugate_gradients.h"

namespace sheet {

namespace {

constexpr double least_shift = 1e-14; // the first one tried when the positive form cannot be factorised, times 100 each
constexpr double greatest_shift = 1e2;
constexpr double shift_of_free = 1e-3; // of the positive form where motions are free that the potential does not see
constexpr double sufficient = 1e-4;    // of the predicted decrease [Armijo]
constexpr int most_halvings = 40;
constexpr double slope_kept = 0.5;     // of the slope that may remain after a step accepted for its slope
constexpr double small_step = 1e-3;    // steps below this are done if the potential has no more to gain
constexpr double lost_step = 1e-13;    // of an edge: a step that is lost in the rounding of positions
constexpr double first_forcing = 0.03; // part of the residual that conjugate gradients leave
constexpr double least_forcing = 1e-6;
constexpr double greatest_forcing = 0.1;
constexpr int most_products = 60; // with the Hessian, a direction
constexpr int few_products = 8;   // as many a direction takes if the factor is close to the Hessian
constexpr int many_products = 5;  // then the factor is made anew
constexpr double served = 0.3;    // of what remained, what a step by the factor alone may leave
constexpr double sharper = 1e-2;  // of the tolerance, after such a step: others leave the square of what remained
constexpr double largest = 1e-2;  // of the step error's rule, of an edge, what may remain at most
constexpr int often = 3;          // in a row near enough, though the preconditioner is not trusted
constexpr double far_away = 0.1;  // of an edge, or radians: if more remains at a start, there may be a better one,
constexpr double much = 0.1;      // or if so much of the energies there can be gained
constexpr double too_much = 0.01; // of the energies, that an earlier place's factor promises to gain, twice
constexpr double farther = 3;     // times what remained before the last step, what such a factor says remains after it

// The greatest of the first `count` numbers of x, each in its own unit. Not a number if one of them is none.
double greatest(const Eigen::VectorXd& x, const Eigen::VectorXd& units, Eigen::Index count) {
  const auto greater = [](double a, double b) { return a > b || std::isnan(a) ? a : b; };
  return tbb::parallel_reduce(
      tbb::blocked_range<Eigen::Index>(0, count, 4096), 0.0,
      [&](const auto& part, double most) {
        const auto size = static_cast<Eigen::Index>(part.size());
        const auto own = x.segment(part.begin(), size).cwiseQuotient(units.segment(part.begin(), size));
        return greater(own.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>(), most);
      },
      greater);
}

class Minimizer {
public:
  Minimizer(LinearSystem& system, const Terms& terms, const Eigen::VectorXd& scale, const Unknowns& extrapolated,
            const NewtonOptions& options, FirstEvaluation first, Unknowns& u, const OtherStart& other)
      : system_(system), terms_(terms), scale_(scale), extrapolated_(extrapolated), options_(options), u_(u),
        other_(other) {
    start_from(std::move(first));
  }

  NewtonReport run() {
    if (starts_well() || (start_elsewhere() && starts_well()))
      iterate();
    return report_;
  }

private:
  void start_from(FirstEvaluation first) {
    energy_ = first.energy;
    start_ = first.energy.value;
    gradient_ = std::move(first.gradient);
    linearized_ = first.linearized;
  }

  [[nodiscard]] bool starts_well() const { return std::isfinite(energy_.value) && gradient_.allFinite(); }

  [[nodiscard]] bool starts_near() const { return remains_ <= far_away && norm_ * norm_ <= much * energy_.magnitude; }

  // At a start of lower potential, if there is one and no one has asked before.
  bool start_elsewhere() {
    if (steps() > 0 || asked_ || !other_)
      return false;
    asked_ = true;
    if (!other_(energy_.value, u_))
      return false;
    if (fresh_)
      system_.forget_factor();
    start_from(evaluate_first(system_, terms_, u_));
    return true;
  }

  void iterate() {
    for (;;) {
      if (!system_.has_factor() && !factorize())
        return;
      measure_remainder();
      if (!starts_near() && start_elsewhere()) {
        if (!starts_well())
          return;
        continue;
      }
      if (!std::isfinite(remains_))
        return;
      if (misled()) {
        leave_factor();
        continue;
      }
      if (converged()) {
        if (near_ < often || trusted())
          take_remainder();
        return;
      }
      if (system_.factor_serves()) {
        follow_factor();
      } else if (options_.renews && !fresh_ && report_.iterations < options_.iterations) {
        system_.forget_factor();
        renewed_ = true;
        continue;
      } else if (report_.iterations < options_.iterations) {
        linearize();
        find_direction();
      } else {
        return;
      }
      if (!std::isfinite(report_.last_step))
        return;
      if (report_.last_step <= lost_step) {
        report_.converged = options_.force_left == 0;
        return;
      }
      const bool was_fresh = fresh_;
      const double length = search();
      if (length == 0) {
        // A fresh factor, of the positive form at last, is tried before the search is given up.
        if (fresh_ && positive_)
          return;
        positive_ = fresh_;
        system_.forget_factor();
      } else if (length < 0.5 && !was_fresh) {
        system_.forget_factor();
      }
      full_ = length == 1;
    }
  }

  // By a factor that was made elsewhere: where layers meet or films buckle, stiffness may change by orders of magnitude
  // between the stages of a step. Along motions that the potential does not see promises mean nothing.
  [[nodiscard]] bool misled() const {
    if (fresh_ || system_.floor() > 0)
      return false;
    const bool promises = !system_.factor_serves() && norm_ * norm_ > too_much * energy_.magnitude;
    return promises || (steps() > 0 && norm_ > farther * previous_norm_);
  }

  // What remained before the last step stays known.
  void leave_factor() {
    norm_ = previous_norm_;
    followed_ = false;
    system_.forget_factor();
  }

  [[nodiscard]] int steps() const { return report_.iterations + report_.followed; }

  // The exact Hessian's factor, else the positive form's, in single precision; else that in full precision, with a
  // shift that grows. Where motions are free that the potential does not see, full precision is needed to tell them
  // apart.
  bool factorize() {
    Stopwatch watch;
    fresh_ = true;
    const bool free = system_.floor() > 0;
    const Precision precision = free ? Precision::full : Precision::single;
    if (!positive_) {
      linearize();
      watch.lap();
      ++report_.factorizations;
      const bool good = system_.factorize(0, precision);
      report_.seconds_factor += watch.lap();
      exact_ = good;
      system_.set_factor_serves(good && !renewed_);
      if (good)
        return true;
    }
    exact_ = false;
    system_.set_factor_serves(false);
    system_.find_positive_form(terms_, u_);
    report_.seconds_assembly += watch.lap();
    const auto attempt = [&](double shift, Precision with) {
      ++report_.factorizations;
      ++report_.positive;
      report_.shifted += shift > 0;
      return system_.factorize(shift, with, Form::positive);
    };
    bool good = !free && attempt(0, Precision::single);
    for (double shift = free ? shift_of_free : 0; !good && shift <= greatest_shift;
         shift = std::max(least_shift, 100 * shift))
      good = attempt(shift, Precision::full);
    report_.seconds_factor += watch.lap();
    return good;
  }

  // The exact Hessian at u.
  void linearize() {
    if (linearized_)
      return;
    Stopwatch watch;
    Eigen::VectorXd same;
    (void)system_.hessian(terms_, u_, same);
    linearized_ = true;
    report_.seconds_assembly += watch.lap();
  }

  // What the preconditioner says is left to go, and its norm in the potential.
  void measure_remainder() {
    Stopwatch watch;
    force_ = -system_.to_rows(gradient_);
    preconditioned_ = system_.solve(force_);
    remainder_ = system_.to_unknowns(preconditioned_);
    previous_norm_ = norm_;
    norm_ = std::sqrt(std::max(0.0, force_.dot(preconditioned_)));
    if (steps() == 0)
      first_norm_ = norm_;
    if (followed_ && !renewed_)
      system_.set_factor_serves(norm_ <= served * previous_norm_);
    const Eigen::Index positions = 3 * static_cast<Eigen::Index>(system_.assembly().vertices());
    remains_ = greatest(remainder_, scale_, remainder_.size());
    positions_remain_ = greatest(remainder_, scale_, positions);
    if (options_.force_left > 0) {
      greatest_force_ = force_.head(positions).lpNorm<Eigen::Infinity>();
      if (steps() == 0)
        first_force_ = greatest_force_;
    }
    way_ = greatest(u_ - extrapolated_, scale_, positions);
    report_.seconds_solve += watch.lap();
  }

  bool converged() {
    const bool strict = trusted() && remains_ <= (followed_ ? sharper : 1) * options_.tolerance;
    const bool near =
        options_.of_step_error > 0 && norm_ <= options_.of_step_error * first_norm_ &&
        positions_remain_ <= std::min(largest, options_.of_step_error * std::max(way_, options_.step_error));
    near_ = near ? near_ + 1 : 0;
    // Slivers and films of no mass may have a curvature that is negative for ever, and move by next to nothing.
    const bool lenient = near_ >= (trusted() ? 1 : often);
    // A direction with the Hessian knows the soft modes too, of which the potential tells little.
    const bool nothing_to_gain =
        steps() > 0 && !followed_ && full_ && remains_ <= small_step && norm_ * norm_ <= energy_.noise();
    const auto balanced = [&](double part) { return greatest_force_ <= part * first_force_; };
    report_.converged =
        (balanced(options_.force_left) && (remains_ <= lost_step || strict || lenient || nothing_to_gain)) ||
        (balanced(options_.force_left_by_error) && lenient);
    return report_.converged;
  }

  // What remains is known, so it costs nothing.
  void take_remainder() {
    system_.balance(force_, preconditioned_);
    u_ += system_.to_unknowns(preconditioned_);
  }

  // Whether the preconditioner tells what remains: it does if it is the Hessian's, or served well for the last
  // direction.
  bool trusted() const {
    if (steps() == 0)
      return fresh_ && exact_;
    return full_ && !negative_ && (followed_ ? system_.factor_serves() : products_ <= few_products);
  }

  // Eisenstat and Walker's second choice, no sharper than what ends the iterations.
  double forcing() const {
    if (steps() == 0)
      return first_forcing;
    const double ratio = norm_ / previous_norm_;
    const double enough = std::max(options_.of_step_error * first_norm_ / norm_, options_.tolerance / remains_);
    return std::clamp(std::max(0.9 * ratio * ratio, 0.3 * enough), least_forcing, greatest_forcing);
  }

  // The step by the factor alone, of this Hessian or an earlier one: a product and a solution less, and no Hessian, for
  // as long as each leaves little of what remained.
  void follow_factor() {
    Stopwatch watch;
    system_.balance(force_, preconditioned_);
    products_ = 0;
    negative_ = false;
    followed_ = true;
    ++report_.followed;
    take_direction(preconditioned_);
    report_.seconds_solve += watch.lap();
  }

  void take_direction(const Eigen::VectorXd& rows) {
    step_ = system_.to_unknowns(rows);
    slope_ = gradient_.dot(step_);
    for (const auto& term : terms_)
      term->follow(u_, step_);
    report_.last_step = greatest(step_, scale_, step_.size());
    report_.gained = start_ - energy_.value;
    report_.promised = -slope_;
  }

  void find_direction() {
    Stopwatch watch;
    followed_ = renewed_ = false;
    const auto multiply = [&](const Eigen::VectorXd& x) { return system_.multiply(x); };
    const auto precondition = [&](const Eigen::VectorXd& b) { return system_.solve(b); };
    ConjugateGradients cg =
        conjugate_gradients(multiply, precondition, force_, preconditioned_, forcing(), most_products);
    if (!cg.negative)
      system_.balance(force_, cg.x);
    take_direction(cg.x);
    products_ = cg.products;
    negative_ = cg.negative;
    if (products_ > many_products && !fresh_)
      stale_ = true;
    report_.products += products_;
    ++report_.iterations;
    report_.seconds_solve += watch.lap();
  }

  // Takes the step, as much of it as lowers the potential enough; returns that part, or 0.
  double search() {
    Stopwatch watch;
    const double noise = energy_.noise();
    double length = 1, taken = 0;
    for (int halvings = 0; halvings <= most_halvings && taken == 0; ++halvings, length *= 0.5) {
      const Unknowns there = u_ + length * step_;
      const EnergySum energy = system_.gradient(terms_, there, trial_);
      const bool finite = std::isfinite(energy.value) && trial_.allFinite();
      const bool lower = energy.value <= energy_.value + sufficient * length * slope_ + noise;
      // A small step may gain less than the potential's own round-off, which strains that nearly cancel make large;
      // then the slope decides [as in Hager and Zhang 2005].
      const bool flatter =
          report_.last_step <= small_step && std::abs(trial_.dot(step_)) <= slope_kept * std::abs(slope_);
      if (finite && (lower || flatter)) {
        taken = length;
        report_.monotone = report_.monotone && (energy.value <= energy_.value + noise || !lower);
        u_ = there;
        energy_ = energy;
        gradient_.swap(trial_);
        linearized_ = false;
      } else {
        ++report_.halvings;
      }
    }
    if (stale_ && taken > 0)
      system_.forget_factor();
    stale_ = false;
    fresh_ = fresh_ && taken == 0;
    positive_ = positive_ && taken == 0;
    report_.seconds_search += watch.lap();
    return taken;
  }

  LinearSystem& system_;
  const Terms& terms_;
  const Eigen::VectorXd& scale_;
  const Unknowns& extrapolated_;
  const NewtonOptions& options_;
  Unknowns& u_;
  const OtherStart& other_;
  NewtonReport report_;
  EnergySum energy_;
  double start_ = 0; // of the potential
  Eigen::VectorXd gradient_, trial_, force_, preconditioned_, remainder_, step_;
  double slope_ = 0, norm_ = 0, previous_norm_ = 0, first_norm_ = 0, remains_ = 0, positions_remain_ = 0, way_ = 0;
  double greatest_force_ = 0, first_force_ = 0; // [N], where that is asked for
  int products_ = 0, near_ = 0;
  bool asked_ = false;      // for another start
  bool linearized_ = false; // the system has the exact Hessian at u
  bool fresh_ = false;      // the factor was made at u
  bool exact_ = false;      // of the exact Hessian
  bool positive_ = false;   // of the positive form, as the exact one's direction failed
  bool negative_ = false;   // curvature, of the last direction
  bool stale_ = false;      // the factor took too many products
  bool renewed_ = false;    // the factor was made for the next direction, not to serve alone
  bool followed_ = false;   // the factor alone gave the last direction
  bool full_ = true;        // the last step was
};

} // namespace

NewtonReport& NewtonReport::operator+=(const NewtonReport& later) {
  converged = later.converged;
  monotone = monotone && later.monotone;
  iterations += later.iterations;
  followed += later.followed;
  products += later.products;
  factorizations += later.factorizations;
  positive += later.positive;
  shifted += later.shifted;
  halvings += later.halvings;
  last_step = later.last_step;
  gained = later.gained;
  promised = later.promised;
  seconds_assembly += later.seconds_assembly;
  seconds_factor += later.seconds_factor;
  seconds_solve += later.seconds_solve;
  seconds_search += later.seconds_search;
  return *this;
}

FirstEvaluation evaluate_first(LinearSystem& system, const Terms& terms, const Unknowns& u) {
  FirstEvaluation first;
  first.linearized = !system.has_factor();
  first.energy =
      first.linearized ? system.hessian(terms, u, first.gradient) : system.gradient(terms, u, first.gradient);
  return first;
}

NewtonReport minimize(LinearSystem& system, const Terms& terms, const Eigen::VectorXd& scale,
                      const Unknowns& extrapolated, const NewtonOptions& options, FirstEvaluation first, Unknowns& u,
                      const OtherStart& other) {
  return Minimizer(system, terms, scale, extrapolated, options, std::move(first), u, other).run();
}

} // namespace sheet
