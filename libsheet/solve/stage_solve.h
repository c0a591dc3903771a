// SPDX-License-Identifier: GPL-3.0-or-later
// The solve of one stage of a time step: starting guess, Newton's method, and, where any state of lower potential will
// do, its damped form.
#pragma once
#include <vector>

#include "libsheet/energy/holds.h"
#include "libsheet/energy/model.h"
#include "libsheet/solve/newton.h"

namespace sheet {

enum class Demand {
  converged,      // to the options' tolerance
  lower_potential // or as far as most of what can be gained is gained
};

class StageSolve {
public:
  // What the stages of a step share.
  StageSolve(LinearSystem& system, const Terms& terms, const std::vector<Hold>& holds, const Eigen::VectorXd& scale,
             const NewtonOptions& options, Demand demand);

  // From the extrapolated state `guess` and the last known one `safe` to the result u, with the terms begun anew. At
  // most `iterations` where convergence is demanded. Adds to the report; false if it failed.
  [[nodiscard]] bool solve(const Stage& stage, const Unknowns& guess, const Unknowns& safe, int iterations,
                           NewtonReport& report, Unknowns& u);

private:
  void place(const Stage& stage, Unknowns& u) const;
  [[nodiscard]] bool solve_at_once(const Stage& stage, const Unknowns& guess, FirstEvaluation first,
                                   NewtonOptions options, NewtonReport& report, Unknowns& u);
  void come_from_softer(const Stage& stage, const Unknowns& guess, const NewtonOptions& options, NewtonReport& report,
                        Unknowns& u);
  // A start of a lower potential than `least`; false where there is none.
  [[nodiscard]] bool find_lower(const Stage& stage, const Unknowns& safe, bool left_behind, double least, Unknowns& u);

  LinearSystem& system_;
  const Terms& terms_;
  const std::vector<Hold>& holds_;
  const Eigen::VectorXd& scale_;
  const NewtonOptions& options_;
  Demand demand_;
};

} // namespace sheet
