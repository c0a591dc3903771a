// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit time step. Schemes:
//   backward Euler  one stage over dt [Batty et al. 2012, section 3.7]
//   SDIRK2          γ = 1 - 1/√2, two stages over γ dt each, second order, L-stable [Alexander 1977], in metric form:
//                   the second stage measures strain from a0 + ((1-γ)/γ)(a1 - a0), curvature likewise, so that each
//                   stage is the minimum of a potential and a rigid motion costs nothing
// A step that does not converge forgets what was overshot before it (energy/overshoot.h); then it is done without arcs,
// then in halves, halves by backward Euler where SDIRK2 fails. When the Newton iterations allowed to a step are spent,
// what is left of it is done by backward Euler, and taken where the last iteration promised to lower the potential by
// less than a hundredth of what all have: a stable step of lower accuracy, in halves if need be, with up to eight times
// the iterations. If that fails too, Error(not_converged), the state untouched.
// Steps chosen by their error are shortened instead of halved. When the iterations are spent, the most accurate step
// that converged is taken, though its error is above the tolerance; if none did, an unfinished one as above. Where a
// step of a thousandth is hardly more accurate, as something jumps, the long one is taken, and said to be inaccurate.
// No step is shorter than the sheet takes to cross 1e-4 of an edge, as it moves or as it did in one that was too long
// (and a thousandth of what is left).
#pragma once
#include <memory>

#include "libsheet/energy/model.h"
#include "libsheet/solve/stage_solve.h"
#include "libsheet/solve/step_report.h"

namespace sheet {

class StepHeat;

enum class Scheme { sdirk2, backward_euler };
enum class Thickness {
  coupled,   // indices raised with the predicted end-of-stage metric: thickness follows area within the step
  as_started // with the start-of-step metric: thickness is updated after the step, as in the paper
};

struct StepOptions {
  Scheme scheme = Scheme::sdirk2;
  Thickness thickness = Thickness::coupled;
  NewtonOptions newton;
  int retries = 12;     // halvings of a step that does not converge
  int iterations = 400; // of Newton, with or without the Hessian, in a step with all its retries, so that a hopeless
                        // one is given up soon
};

inline constexpr double default_tolerance = 1e-2;

// Steps chosen by the error estimate. `dt` is the next step to try [s]; 0: not known yet.
struct StepControl {
  double tolerance = default_tolerance; // of an edge length a step
  double dt = 0;
};

class Stepper {
public:
  Stepper(Model model, StepOptions options);
  ~Stepper();
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;

  // Advances the state by exactly dt [s].
  StepReport step(State& state, double dt);
  // Advances the state by one step that keeps the error estimate below control.tolerance, if any does, and does not
  // pass `until` [s]; lands on it exactly. Leaves the next step in control.dt.
  StepReport step_within(State& state, double until, StepControl& control);
  // New contacts, holds or forces; the analysis is kept if the same elements remain.
  void set_model(Model model);
  [[nodiscard]] const Model& model() const { return model_; }
  // Whether steps are done without arcs at once, as those before did not converge with them.
  void rest_arcs(bool rest) { arcs_rest_ = rest; }

private:
  struct Cache;
  class ChosenStep;
  enum class Outcome { done, not_converged, shrinks_to_nothing, slides_too_far, cools_too_fast };
  // How the error is estimated: plainly where it is only told, filtered where steps are chosen by it.
  enum class Estimate { plain, filtered };
  Outcome attempt(const State& state, double dt, Scheme scheme, Demand demand, Estimate estimate, State& end,
                  StepReport& report);
  // state: put back (energy/overshoot.h).
  Outcome attempt_from(const State& state, double dt, Scheme scheme, Demand demand, Estimate estimate, State& end,
                       StepReport& report);
  // heat: null without.
  Outcome finish_step(const State& state, double dt, Stage& stage, const Unknowns& first, const Unknowns& last,
                      const Eigen::VectorXd& scale, Estimate estimate, const StepHeat* heat, State& end,
                      StepReport& report);
  void stop_free_motion(const State& state, const Stage& stage, State& end) const;
  void set_prescribed_velocities(const Stage& stage, State& end) const;
  void estimate_error(const State& state, double dt, const Stage& stage, const Unknowns& first, const Unknowns& last,
                      const State& end, const Eigen::VectorXd& scale, Estimate estimate, StepReport& report) const;
  void take_away_overshoot(const Stage& stage, double gamma, const Unknowns& last, Eigen::VectorXd& e,
                           Eigen::VectorXd& speeds) const;
  Outcome attempt_either(const State& state, double dt, State& end, bool& flat, StepReport& report);
  void advance(State& state, double dt, int depth, Estimate estimate, StepReport& report);
  void prepare_cache(const State& state, StepReport& report);
  // With those of unfinished substeps.
  [[nodiscard]] int hopeless_iterations() const { return 8 * options_.iterations; }
  [[nodiscard]] bool has_arcs() const { return model_.arcs && model_.has_angles(); }
  Stepper& without_arcs();
  void advance_flat(State& state, double dt, StepReport& report);
  void clear_times();
  void tell_times(StepReport& report) const;

  Model model_;
  StepOptions options_;
  std::unique_ptr<Cache> cache_;
  bool arcs_rest_ = false;
  std::unique_ptr<Stepper> flat_; // the same without arcs, for steps that do not converge with them
};

} // namespace sheet
