// SPDX-License-Identifier: GPL-3.0-or-later
// One implicit time step. Schemes:
//   backward Euler  one stage over dt [Batty et al. 2012, section 3.7]
//   SDIRK2          γ = 1 - 1/√2, two stages over γ dt each, second order, L-stable [Alexander 1977], in metric form:
//   the
//                   second stage measures strain from a0 + ((1-γ)/γ)(a1 - a0), curvature likewise, so that each stage
//                   is the minimum of a potential and a rigid motion costs nothing
// A step that does not converge is done in halves; if that fails too, Error(not_converged), the state untouched.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "libsheet/energy/model.h"
#include "libsheet/solve/newton.h"

namespace sheet {

enum class Scheme { sdirk2, backward_euler };
enum class Thickness {
  coupled,   // indices raised with the predicted end-of-stage metric: thickness follows area within the step
  as_started // with the start-of-step metric: thickness is updated after the step, as in the paper
};

struct StepOptions {
  Scheme scheme = Scheme::sdirk2;
  Thickness thickness = Thickness::coupled;
  NewtonOptions newton;
  int retries = 12; // halvings of a step that does not converge
};

struct TermTime {
  std::string name;
  double seconds = 0;
};

struct StepReport {
  int substeps = 0;        // 1 unless the step had to be cut
  int failed = 0;          // attempts that did not converge
  int euler_fallbacks = 0; // substeps that only backward Euler could do
  NewtonReport newton;     // sums over all stages; last_step of the last one
  double error = 0;        // difference to the first-order result, in edge lengths, greatest of the substeps
  double seconds_analysis = 0;
  std::vector<TermTime> terms; // assembled terms, their element work summed over threads; last: gathering
};

class Stepper {
 public:
  Stepper(Model model, StepOptions options);
  ~Stepper();
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;

  // Advances the state by exactly dt [s].
  StepReport step(State& state, double dt);
  [[nodiscard]] const Model& model() const { return model_; }

 private:
  struct Attempt;
  struct Cache;
  bool attempt(const State& state, double dt, Scheme scheme, State& end, StepReport& report);
  void advance(State& state, double dt, int depth, StepReport& report);
  void prepare_cache(const State& state);

  Model model_;
  StepOptions options_;
  std::unique_ptr<Cache> cache_;
};

} // namespace sheet
